// SPDX-License-Identifier: Apache-2.0
#include "basestation/alarms/alarm.hpp"

#include <algorithm>

namespace pitwall::alarms {

std::string_view text_of(State state) {
  constexpr std::array<std::string_view, 7> kTexts{"normal",  "unack",   "acked",     "rtn_unack",
                                                   "latched", "shelved", "suppressed"};
  return kTexts.at(static_cast<std::size_t>(state));
}

State Alarm::state() const {
  if (shelved_until_) return State::kShelved;
  if (!active_ && !unacknowledged_ && !latched_) return State::kNormal;
  if (suppressed_) return State::kSuppressed;
  if (active_) return unacknowledged_ ? State::kUnack : State::kAcked;
  return unacknowledged_ ? State::kReturnedUnack : State::kLatched;
}

bool Alarm::broken(const AlarmRow& row, const AlarmSetting& setting, double value) const {
  const double back = raw_ ? setting.deadband : 0.0;
  return row.side == Side::kAbove ? value > setting.limit - back : value < setting.limit + back;
}

bool Alarm::update(const AlarmRow& row, const AlarmSetting& setting, const Reading& reading,
                   bool suppressed, Instant now) {
  if (shelved_until_ && now >= *shelved_until_) {
    shelved_until_.reset();
    unacknowledged_ = unacknowledged_ || active_;
  }
  suppressed_ = suppressed;
  if (suppressed || !reading.usable) {
    raw_ = counted_ = active_;  // nothing is on its way
    return false;
  }
  value_ = reading.value;
  if (const bool is = broken(row, setting, reading.value); is != raw_) {
    raw_ = is;
    raw_since_ = now;
    counted_ = false;
  }
  const Duration lasted = now - raw_since_;
  bool announced = false;
  if (raw_ && !counted_ && lasted >= setting.on_delay) announced = activate(row, now);
  const Duration quiet = folded_ ? std::max(setting.off_delay, kChatterWindow) : setting.off_delay;
  if (!raw_ && active_ && lasted >= quiet) deactivate();
  return announced;
}

// True: to be announced. A coming within the fold is only counted.
bool Alarm::activate(const AlarmRow& row, Instant now) {
  counted_ = true;
  if (active_ && !folded_) return false;  // it had not gone yet: its off-delay still ran
  ++count_;
  activations_[activation_count_++ % kChatterCount] = now;
  if (active_) return false;
  active_ = unacknowledged_ = true;
  latched_ = row.latched;
  since_ = now;
  const Instant oldest = *std::min_element(activations_.begin(), activations_.end());
  folded_ = activation_count_ >= kChatterCount && now - oldest <= kChatterWindow;
  return true;
}

void Alarm::deactivate() {
  active_ = folded_ = false;
  settle();
}

void Alarm::settle() {
  if (!active_ && !unacknowledged_ && !latched_) count_ = 0;
}

bool Alarm::acknowledge() {
  if (state() != State::kUnack && state() != State::kReturnedUnack) return false;
  unacknowledged_ = false;
  settle();
  return true;
}

bool Alarm::shelve(Instant until) {
  switch (state()) {
    case State::kNormal:
    case State::kShelved:
    case State::kSuppressed:
      return false;
    default:
      shelved_until_ = until;
      return true;
  }
}

bool Alarm::unshelve() {
  if (!shelved_until_) return false;
  shelved_until_.reset();
  unacknowledged_ = false;
  settle();
  return true;
}

bool Alarm::reset() {
  if (state() != State::kLatched) return false;
  latched_ = false;
  settle();
  return true;
}

}  // namespace pitwall::alarms

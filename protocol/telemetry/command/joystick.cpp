// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/command/joystick.hpp"

#include <algorithm>
#include <cmath>

#include "protocol/vocabulary/sequence.hpp"

namespace pitwall::telemetry {
namespace {

constexpr FieldIndex kActive = field("joystick.active"), kNumber = field("joystick.sample"),
                     kAge = field("joystick.sample_age"), kCap = field("joystick.throttle_cap"),
                     kBrake = field("joystick.brake");
constexpr auto kSamples = static_cast<std::uint32_t>(kFields[kNumber].quantized().count());
constexpr std::int64_t kMillisecond = 1'000'000;
static_assert(kFields[kAge].resolution == 1.0 &&
              kFields[kAge].max >= kJoystickOldAtSending.milliseconds() + 1.0);

}  // namespace

void JoystickSender::sample(const JoystickSample& sample, Instant at) {
  if (std::isnan(sample.throttle_cap) || std::isnan(sample.brake)) return;
  newest_ = {std::clamp(sample.throttle_cap, 0.0, 1.0), std::clamp(sample.brake, 0.0, 1.0)};
  number_ = static_cast<std::uint16_t>((number_ + 1U) % kSamples);
  at_ = at;
}

void JoystickSender::put(Values& values, Instant now) const {
  const bool live = at_ && now - *at_ <= kJoystickOldAtSending;
  values[kActive] = live ? 1.0 : 0.0;
  values[kNumber] = live ? number_ : kUnset;
  // Rounded up: nobody takes the sample for younger than it is.
  values[kAge] = live ? static_cast<double>((now - *at_).ns / kMillisecond + 1) : kUnset;
  values[kCap] = live ? newest_.throttle_cap : kUnset;
  values[kBrake] = live ? newest_.brake : kUnset;
}

void JoystickReceiver::receive(const Values& values, const Received& received) {
  // Unset numbers fail these comparisons; what a device no longer says dies of its age.
  const bool whole = values[kActive] == 1.0 && values[kNumber] >= 0 && values[kAge] >= 0 &&
                     values[kCap] >= 0 && values[kBrake] >= 0;
  if (!whole) return;
  if (!received.sent_earliest) {
    ++counters_.unknown_age;
    return;
  }
  const auto number = static_cast<std::uint16_t>(values[kNumber]);
  if (alive(received.at) && !is_newer(number, number_, kSamples)) {
    ++counters_.repeated;
    return;
  }
  // A sender whose clock stands in the future does not make its samples younger.
  const Instant sent = std::min(*received.sent_earliest, received.at);
  const Instant taken = sent - from_seconds(values[kAge] * 1e-3);
  if (received.at - taken > kJoystickDead) {
    ++counters_.too_old;
    return;
  }
  ++counters_.samples;
  newest_ = {values[kCap], values[kBrake]};
  number_ = number;
  taken_at_ = taken;
}

std::optional<JoystickSample> JoystickReceiver::sample(Instant now) const {
  if (!alive(now)) return std::nullopt;
  return newest_;
}

void JoystickReceiver::base_restarted() {
  taken_at_.reset();
  number_ = 0;
}

}  // namespace pitwall::telemetry

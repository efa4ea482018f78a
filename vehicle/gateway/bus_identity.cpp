// SPDX-License-Identifier: Apache-2.0
#include "vehicle/gateway/bus_identity.hpp"

#include <cstdio>

#include "protocol/can/manifest.hpp"

namespace pitwall::gateway {
namespace {

using can::av21::kMessages;
using world::BusIdentity;
using world::IdentityDifference;
using world::IdentityVerdict;

constexpr Duration kPaceSpan = seconds(1);  // shorter, a stall would look like another period
constexpr double kPaceShare = 0.75;         // of it or of the period; a frame may come early
constexpr double kPeriodsLeast = 0.4, kPeriodsMost = 2.5;
constexpr std::size_t kNotFound = kMessages.size();

std::size_t index_of(std::uint32_t id) {
  const auto row = std::ranges::lower_bound(kMessages, id, {}, &can::MessageRow::id);
  if (row == kMessages.end() || row->id != id) return kNotFound;
  return static_cast<std::size_t>(row - kMessages.begin());
}

bool ignored(std::uint32_t id) {
  return std::ranges::any_of(can::av21::kIgnoredIds, [id](const can::IdRange& range) {
    return id >= range.first && id <= range.last;
  });
}

bool is_proof(IdentityDifference difference) {
  return difference == IdentityDifference::kUnknownId ||
         difference == IdentityDifference::kWrongLength ||
         difference == IdentityDifference::kWrongFormat;
}

// What is remembered of the verdict, nothing of the frames: they may be hours old.
void begin(IdentityState& state, Instant now) {
  state.listening = true;
  state.since = state.difference = now;
  state.stranger = {};
  for (ReceivedMessage& message : state.messages)
    message = {.period_confirmed = message.period_confirmed};
}

void differs(IdentityState& state, std::size_t index, IdentityDifference difference,
             double measured, Instant now) {
  ReceivedMessage& message = state.messages[index];
  message.difference = difference;
  message.differed = state.difference = now;
  message.measured = measured;
}

void hear_stranger(const IdentityParams& params, IdentityState& state, const can::Frame& frame,
                   Instant now) {
  Stranger& stranger = state.stranger;
  const bool old = !stranger.received || now - stranger.at >= params.listen;
  if (old || frame.id <= stranger.id)
    stranger = {.received = true, .id = frame.id, .at = now, .bytes = 1.0 * frame.length};
  state.difference = now;
}

double mean_interval_s(const ReceivedMessage& message) {
  return (message.last - message.first).seconds() / message.intervals;
}

void judge_pace(const IdentityParams& params, IdentityState& state, std::size_t index,
                Instant now) {
  ReceivedMessage& message = state.messages[index];
  const Duration period = kMessages[index].period;
  const Duration span = message.last - message.first;
  if (span.seconds() < kPaceShare * std::max(kPaceSpan, period).seconds()) return;
  const double mean_s = mean_interval_s(message);
  const bool fits =
      mean_s >= kPeriodsLeast * period.seconds() && mean_s <= kPeriodsMost * period.seconds();
  if (!fits && (span < params.listen || message.intervals < 2)) return;
  if (!fits) differs(state, index, IdentityDifference::kWrongPeriod, mean_s, now);
  message.period_confirmed = fits;
  message.first = message.last;
  message.intervals = 0;
}

void receive(const IdentityParams& params, IdentityState& state, const can::ReceivedFrame& received,
             Instant now) {
  const can::Frame& frame = received.frame;
  const bool standard = !frame.extended;
  const std::size_t index = index_of(frame.id);
  if (index == kNotFound) {
    const bool known = standard && std::ranges::find(params.also, frame.id, &can::MessageRow::id) !=
                                       params.also.end();
    if (!known && (!standard || !ignored(frame.id))) hear_stranger(params, state, frame, now);
    return;
  }
  const can::MessageRow& row = kMessages[index];
  if (row.direction == can::Direction::kToCar) return;
  if (!standard || frame.remote || frame.fd)
    return differs(state, index, IdentityDifference::kWrongFormat, frame.length, now);
  if (frame.length != row.length)
    return differs(state, index, IdentityDifference::kWrongLength, frame.length, now);
  ReceivedMessage& message = state.messages[index];
  const Instant at = std::min(received.at, now);  // a stamp from the future says nothing
  if (message.received && at - message.last < params.listen) {
    message.last = at;
    ++message.intervals;
    return judge_pace(params, state, index, now);
  }
  message.received = true;
  message.first = message.last = at;
  message.intervals = 0;
}

void look_for_silence(const IdentityParams& params, IdentityState& state, Instant now) {
  for (std::size_t i = 0; i < kMessages.size(); ++i) {
    ReceivedMessage& message = state.messages[i];
    const Duration silence = now - (message.received ? message.last : state.since);
    const bool proven = is_proof(message.difference) && now - message.differed < params.listen;
    if (!kMessages[i].required || silence < params.listen || proven) continue;
    differs(state, i, IdentityDifference::kNotReceived, silence.seconds(), now);
    message.period_confirmed = false;
  }
}

double expected_of(IdentityDifference difference, const can::MessageRow& row) {
  return is_proof(difference) ? 1.0 * row.length : row.period.seconds();
}

// The difference to name: the smallest id of the last `listen`, proof first.
BusIdentity named(const IdentityParams& params, const IdentityState& state, Instant now) {
  const auto recent = [&](Instant at) { return now - at < params.listen; };
  BusIdentity best{.verdict = IdentityVerdict::kWrong};
  for (std::size_t i = 0; i < kMessages.size(); ++i) {
    const ReceivedMessage& message = state.messages[i];
    const IdentityDifference difference = message.difference;
    if (difference == IdentityDifference::kNone || !recent(message.differed)) continue;
    const bool better = best.difference == IdentityDifference::kNone ||
                        (is_proof(difference) && !is_proof(best.difference));
    if (!better) continue;  // the rows are sorted by id
    best.difference = difference;
    best.id = kMessages[i].id;
    best.expected = expected_of(difference, kMessages[i]);
    best.received = message.measured;
  }
  const Stranger& stranger = state.stranger;
  if (!stranger.received || !recent(stranger.at)) return best;
  if (is_proof(best.difference) && best.id < stranger.id) return best;
  return {.verdict = IdentityVerdict::kWrong,
          .difference = IdentityDifference::kUnknownId,
          .id = stranger.id,
          .received = stranger.bytes};
}

bool all_acquitted(const IdentityState& state) {
  for (std::size_t i = 0; i < kMessages.size(); ++i)
    if (kMessages[i].required && !state.messages[i].period_confirmed) return false;
  return true;
}

BusIdentity judge(const IdentityParams& params, const IdentityState& state, Instant now) {
  const BusIdentity right{.verdict = IdentityVerdict::kRight};
  const BusIdentity wrong = named(params, state, now);
  if (wrong.difference != IdentityDifference::kNone) return wrong;
  switch (state.verdict.verdict) {
    case IdentityVerdict::kListening:
      return all_acquitted(state) ? right : state.verdict;
    case IdentityVerdict::kWrong:
      return all_acquitted(state) && now - state.difference >= params.listen ? right
                                                                             : state.verdict;
    case IdentityVerdict::kRight:
      return right;
  }
  return right;
}

std::string format(const char* pattern, auto... values) {
  char text[160];
  const int length = std::snprintf(text, sizeof text, pattern, values...);
  return {text, std::min(sizeof text - 1, static_cast<std::size_t>(std::max(length, 0)))};
}

std::string what_differs(const BusIdentity& identity) {
  const double expected_ms = 1e3 * identity.expected;
  switch (identity.difference) {
    case IdentityDifference::kNone:
      return "";
    case IdentityDifference::kUnknownId:
      return format("%.0f bytes on the bus, no such message", identity.received);
    case IdentityDifference::kWrongLength:
      return format("%.0f bytes on the bus, %.0f", identity.received, identity.expected);
    case IdentityDifference::kWrongFormat:
      return "a remote, FD or extended frame on the bus, a classic one";
    case IdentityDifference::kNotReceived:
      return format("not heard for %.1f s, every %.0f ms", identity.received, expected_ms);
    case IdentityDifference::kWrongPeriod:
      return format("every %.0f ms on the bus, every %.0f ms", 1e3 * identity.received,
                    expected_ms);
  }
  return "";
}

}  // namespace

BusIdentity identify(const IdentityParams& params, IdentityState& state,
                     std::span<const can::ReceivedFrame> frames, bool armed, Instant now) {
  state.verdict.database = can::av21::kFingerprint;
  if (armed) {
    state.listening = false;
    return state.verdict;
  }
  if (!state.listening) begin(state, now);
  for (const can::ReceivedFrame& received : frames) receive(params, state, received, now);
  look_for_silence(params, state, now);
  state.verdict = judge(params, state, now);
  state.verdict.database = can::av21::kFingerprint;
  return state.verdict;
}

std::string sentence(const BusIdentity& identity) {
  const std::string database = std::string("database ") + can::av21::kRevision;
  if (identity.verdict == IdentityVerdict::kListening)
    return "the CAN bus is not yet known to be that of " + database;
  if (identity.verdict == IdentityVerdict::kRight) return "the CAN bus is that of " + database;
  const std::size_t index = index_of(identity.id);
  const std::string name = index == kNotFound ? "" : std::string(" ") + kMessages[index].name;
  return "CAN id " + std::to_string(identity.id) + name + ": " + what_differs(identity) + " in " +
         database;
}

std::string database_text() {
  return std::string(can::av21::kDatabase) + ", " + can::av21::kRevision +
         format(", fingerprint %016llx", static_cast<unsigned long long>(can::av21::kFingerprint));
}

}  // namespace pitwall::gateway

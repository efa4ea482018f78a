// SPDX-License-Identifier: Apache-2.0
#include "basestation/inputs/joystick_reports.hpp"

#include <linux/input.h>

#include <algorithm>
#include <charconv>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

namespace pitwall::inputs {
namespace {

// So far beyond its calibrated ends an axis may go; farther it is broken.
constexpr double kOvertravel = 0.1;
constexpr int kHighestCode = KEY_MAX;

Unexpected<Problem> refuse(std::string_view entry, const std::string& what) {
  return Unexpected{Problem{"joystick: " + std::string{entry}, what}};
}

// Numbers between colons; empty where one is none.
std::vector<std::int32_t> numbers_of(std::string_view text) {
  std::vector<std::int32_t> numbers;
  while (true) {
    const std::string_view part = text.substr(0, text.find(':'));
    std::int32_t number = 0;
    const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), number);
    if (error != std::errc{} || end != part.data() + part.size()) return {};
    numbers.push_back(number);
    if (part.size() == text.size()) return numbers;
    text.remove_prefix(part.size() + 1);
  }
}

Result<JoystickAxis, Problem> axis_of(std::string_view entry, std::span<const std::int32_t> from) {
  if (from.size() != 3) return refuse(entry, "expected CODE:RELEASED:PRESSED");
  if (from[0] < 0 || from[0] > ABS_MAX)
    return refuse(entry, "expected an axis code of 0 to " + std::to_string(ABS_MAX));
  if (from[1] == from[2]) return refuse(entry, "released and pressed are the same value");
  return JoystickAxis{static_cast<std::uint16_t>(from[0]), from[1], from[2]};
}

}  // namespace

static_assert(sizeof(input_event) == 24);

Result<JoystickMapping, Problem> JoystickMapping::parse(std::string_view text) {
  JoystickMapping mapping;
  while (!text.empty()) {
    const std::string_view entry = text.substr(0, text.find(','));
    text.remove_prefix(std::min(text.size(), entry.size() + 1));
    const std::size_t equals = entry.find('=');
    if (equals == std::string_view::npos) return refuse(entry, "expected NAME=NUMBERS");
    const std::string_view name = entry.substr(0, equals);
    const auto numbers = numbers_of(entry.substr(equals + 1));
    if (name == "enable") {
      const bool valid = numbers.size() == 1 && numbers[0] > 0 && numbers[0] <= kHighestCode;
      if (!valid) return refuse(entry, "no such key");
      mapping.enable_key = static_cast<std::uint16_t>(numbers[0]);
    } else if (name == "lift" || name == "brake") {
      const auto axis = axis_of(entry, numbers);
      if (!axis) return Unexpected{axis.error()};
      (name == "lift" ? mapping.lift : mapping.brake) = *axis;
    } else {
      return refuse(entry, "expected one of: lift, brake, enable");
    }
  }
  if (mapping.lift.code == mapping.brake.code) {
    return refuse("lift, brake", "expected two different axes");
  }
  return mapping;
}

std::optional<telemetry::JoystickSample> JoystickReports::feed(
    std::span<const std::uint8_t> bytes) {
  std::optional<telemetry::JoystickSample> newest;
  while (!bytes.empty()) {
    const std::size_t piece = std::min(bytes.size(), kEventBytes - have_);
    std::memcpy(partial_.data() + have_, bytes.data(), piece);
    bytes = bytes.subspan(piece);
    have_ += piece;
    if (have_ < kEventBytes) break;
    have_ = 0;
    input_event event{};
    std::memcpy(&event, partial_.data(), sizeof event);
    const bool report = event.type == EV_SYN;
    const auto sample = take({event.type, event.code, event.value});
    // A report without a sample ends the hand: an older sample of the same bytes is no more.
    if (report) newest = sample;
  }
  return newest;
}

void JoystickReports::forget() {
  have_ = 0;
  lift_.reset();
  brake_.reset();
  enabled_ = dropping_ = false;
}

std::optional<telemetry::JoystickSample> JoystickReports::take(const Event& event) {
  if (event.type == EV_SYN && event.code == SYN_DROPPED) {
    ++counters_.lost_events;
    forget();
    dropping_ = true;  // until the report that ends what is incomplete
    return std::nullopt;
  }
  if (event.type == EV_SYN && event.code == SYN_REPORT) {
    if (std::exchange(dropping_, false)) return std::nullopt;
    return report();
  }
  if (dropping_) return std::nullopt;
  if (event.type == EV_ABS && event.code == mapping_.lift.code) lift_ = event.value;
  if (event.type == EV_ABS && event.code == mapping_.brake.code) brake_ = event.value;
  if (event.type == EV_KEY && event.code == mapping_.enable_key) enabled_ = event.value != 0;
  return std::nullopt;
}

std::optional<telemetry::JoystickSample> JoystickReports::report() {
  const auto none = [](std::uint64_t& reason) {
    ++reason;
    return std::nullopt;
  };
  ++counters_.reports;
  if (!enabled_) return none(counters_.not_enabled);
  if (!lift_ || !brake_) return none(counters_.unknown_axis);
  const auto lift = pressed(mapping_.lift, lift_), brake = pressed(mapping_.brake, brake_);
  if (!lift || !brake) return none(counters_.out_of_range);
  ++counters_.samples;
  return telemetry::JoystickSample{.throttle_cap = 1.0 - *lift, .brake = *brake};
}

std::optional<double> JoystickReports::pressed(const JoystickAxis& axis,
                                               std::optional<std::int32_t> value) const {
  const double released = axis.released, span = double{1} * axis.pressed - released;
  const double share = (*value - released) / span;
  if (!(share >= -kOvertravel && share <= 1.0 + kOvertravel)) return std::nullopt;
  return std::clamp(share, 0.0, 1.0);
}

}  // namespace pitwall::inputs

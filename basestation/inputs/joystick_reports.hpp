// Decoder of joystick reports of the kernel (evdev): axes and keys become joystick samples.
//   in     bytes of struct input_event, in pieces of any size; which axis and key mean what
//   out    one sample for each report of the device while the enabling key is held, and none
//          without a report: without samples the sender lets go after 100 ms and the car after
//          200 ms
//   invariants
//          no sample before both axes were reported, nor after lost events until both are reported
//          again, nor without the key, nor with a value outside the calibrated range
//   units  axes in steps of the device; a sample 0 .. 1
//   errors counted by reason; parse(): Problem with the entry
//   source Linux: Documentation/input/input.rst, event-codes.rst
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "protocol/telemetry/command/joystick.hpp"
#include "protocol/vocabulary/result.hpp"

namespace pitwall::inputs {

struct JoystickAxis {
  std::uint16_t code = 0;
  std::int32_t released = 0, pressed = 255;  // values of the device at 0 and at 1
};

struct JoystickMapping {
  JoystickAxis lift{.code = 2};    // ABS_Z, the left trigger; at 1 no throttle passes
  JoystickAxis brake{.code = 5};   // ABS_RZ, the right trigger
  std::uint16_t enable_key = 310;  // BTN_TL, held

  // "lift=2:0:255,brake=5:0:255,enable=310"; an entry that is missing keeps its default.
  static Result<JoystickMapping, Problem> parse(std::string_view text);
};

struct JoystickCounters {
  std::uint64_t reports = 0, samples = 0;
  std::uint64_t not_enabled = 0, unknown_axis = 0, out_of_range = 0;  // reports without a sample
  std::uint64_t lost_events = 0;  // times that the kernel's queue was full
};

class JoystickReports {
 public:
  explicit JoystickReports(const JoystickMapping& mapping) : mapping_(mapping) {}

  // Returns the newest sample of these bytes, or nullopt.
  std::optional<telemetry::JoystickSample> feed(std::span<const std::uint8_t> bytes);
  // Clears the state of a lost device.
  void forget();
  bool enabled() const { return enabled_; }
  const JoystickCounters& counters() const { return counters_; }

 private:
  struct Event {
    std::uint16_t type, code;
    std::int32_t value;
  };

  std::optional<telemetry::JoystickSample> take(const Event& event);
  std::optional<telemetry::JoystickSample> report();
  std::optional<double> pressed(const JoystickAxis& axis, std::optional<std::int32_t> value) const;

  static constexpr std::size_t kEventBytes = 24;  // of a 64-bit kernel

  JoystickMapping mapping_;
  std::array<std::uint8_t, kEventBytes> partial_{};
  std::size_t have_ = 0;
  std::optional<std::int32_t> lift_, brake_;
  bool enabled_ = false, dropping_ = false;
  JoystickCounters counters_;
};

}  // namespace pitwall::inputs

// Joystick of the operator in the event loop of the base: its reports become samples for the car.
//   in     an input device (/dev/input/event*), or any descriptor that yields struct input_event
//   out    samples, each with the time at which it was read
//   invariants
//          a lost device gives no samples, so that the car's dead-man timeout ends its last one. It
//          is opened again each second, with a new state: the enabling key must be pressed again
//   errors open(): Problem if there is no such device at the start; later it is waited for
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "basestation/inputs/joystick_reports.hpp"
#include "protocol/telemetry/command/joystick.hpp"
#include "protocol/transport/posix_call.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::inputs {

class JoystickDevice {
 public:
  static constexpr Duration kRetry = seconds(1);
  using Sink = std::function<void(const telemetry::JoystickSample&, Instant)>;

  static Result<JoystickDevice, Problem> open(const std::string& path,
                                              const JoystickMapping& mapping);
  // For a descriptor that is open already, such as a pipe; it is not opened again.
  static JoystickDevice of(transport::FileDescriptor device, const JoystickMapping& mapping);

  // Reads the reports that wait; tries to open a lost device again.
  void read(Instant now, const Sink& sink);
  Instant due() const;
  int fd() const { return device_.get(); }

  bool present() const { return present_; }
  // The device is gone, or its key is held and no report comes: the car no longer follows it.
  bool lost(Instant now) const {
    return !present_ ||
           (reports_.enabled() && sampled_ && now - *sampled_ > telemetry::kJoystickDead);
  }
  const JoystickReports& reports() const { return reports_; }

 private:
  JoystickDevice(std::string path, transport::FileDescriptor device, const JoystickMapping& mapping)
      : path_(std::move(path)), device_(std::move(device)), reports_(mapping) {}
  void lose(Instant now);
  void reopen(Instant now);

  std::string path_;
  // Keeps its number, so that others can poll it; without a device it is an eventfd that stays
  // silent.
  transport::FileDescriptor device_;
  JoystickReports reports_;
  bool present_ = true;
  Instant retry_at_{};
  std::optional<Instant> sampled_;
};

}  // namespace pitwall::inputs

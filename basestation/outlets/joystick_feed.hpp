// The joystick of the operator as part of the base's loop: its reports become samples for the car.
//   in     an input device (/dev/input/event*), or any descriptor that yields struct input_event
//   out    samples to the radio's sender, each with the time at which it was read
//   law    a device that is gone gives nothing: the car's own dead man ends what it said. It is
//          opened again each second, and then nothing of before counts: the key is pressed anew
//   errors open(): Problem where there is no such device at the start; later it is waited for
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "basestation/intake/joystick_reports.hpp"
#include "basestation/outlets/outlet.hpp"
#include "protocol/transport/posix_call.hpp"

namespace pitwall::outlets {

class JoystickFeed : public Outlet {
 public:
  static constexpr Duration kRetry = seconds(1);
  using Told = std::function<void(const telemetry::JoystickSample&, Instant)>;

  static Result<JoystickFeed, Problem> open(const std::string& path,
                                            const intake::JoystickMapping& mapping);
  // A descriptor that is open already, for example a pipe; it is not opened again.
  static JoystickFeed of(transport::FileDescriptor device, const intake::JoystickMapping& mapping);

  void packet(const intake::Station&, const telemetry::Arrival&) override {}
  void serve(intake::Station& station, Instant now) override;
  Instant due() const override;
  int fd() const override { return device_.get(); }

  bool present() const { return present_; }
  // The device is gone, or its key is held and it says nothing: the car has let go of it.
  bool lost(Instant now) const {
    return !present_ ||
           (reports_.enabled() && sampled_ && now - *sampled_ > telemetry::kJoystickDead);
  }
  const intake::JoystickReports& reports() const { return reports_; }
  void tell(Told told) { told_ = std::move(told); }  // for the recorder

 private:
  JoystickFeed(std::string path, transport::FileDescriptor device,
               const intake::JoystickMapping& mapping)
      : path_(std::move(path)), device_(std::move(device)), reports_(mapping) {}
  void lose(Instant now);
  void look_again(Instant now);

  std::string path_;
  // The same number for ever, for who waits on it: while there is no device, nothing comes of it.
  transport::FileDescriptor device_;
  intake::JoystickReports reports_;
  bool present_ = true;
  Instant retry_at_{};
  std::optional<Instant> sampled_;
  Told told_;
};

}  // namespace pitwall::outlets

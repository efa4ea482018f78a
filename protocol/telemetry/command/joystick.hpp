// Operator's joystick over the radio: it can only slow the car down, and only while fresh samples
// of the device arrive.
//   in     base: samples of the input device as they are read. Car: the fields of Group::kJoystick
//          of each packet, and the age of the packet
//   out    base: fields for the next packet. Car: throttle cap and brake demand, or nullopt
//   invariants
//          a sample expires at an age of 200 ms, whatever packets repeat meanwhile: a repeated
//          sample number is no new sample. A sample older than 100 ms on sending, or 200 ms on use
//          (transmission and queue included), is invalid. Nothing here can raise the throttle
//          only an input device can create a sample
//          a number far ahead locks out no later one: after its sample expires, any number is new
//   units  throttle cap and brake 0 .. 1
//   errors a NaN sample is ignored; a value out of range is clamped
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "protocol/telemetry/packet/body.hpp"
#include "protocol/telemetry/registry/registry.hpp"
#include "protocol/vocabulary/time.hpp"
#include "protocol/vocabulary/units.hpp"

namespace pitwall::telemetry {

inline constexpr Duration kJoystickDead = milliseconds(200);
inline constexpr Duration kJoystickOldAtSending = milliseconds(100);

struct JoystickSample {
  double throttle_cap = 1.0, brake = 0.0;
};

class JoystickSender {
 public:
  void sample(const JoystickSample& sample, Instant at);  // a reading of the device
  void put(Values& values, Instant now) const;

 private:
  JoystickSample newest_;
  std::uint16_t number_ = 0;
  std::optional<Instant> at_;
};

struct JoystickCounters {
  std::uint64_t samples = 0, repeated = 0, too_old = 0, unknown_age = 0;
};

class JoystickReceiver {
 public:
  // If `received.sent_earliest` is empty, the clocks are not compared and the sample is not used.
  void receive(const Values& values, const Received& received);
  std::optional<JoystickSample> sample(Instant now) const;
  // Time of the sample from sample(), on the car's clock, never later than the true time.
  std::optional<Instant> sampled_at() const { return taken_at_; }
  void base_restarted();
  const JoystickCounters& counters() const { return counters_; }

 private:
  bool alive(Instant now) const { return taken_at_ && now - *taken_at_ <= kJoystickDead; }

  JoystickSample newest_;
  std::uint16_t number_ = 0;
  std::optional<Instant> taken_at_;  // time of the sample, on the car's clock
  JoystickCounters counters_;
};

}  // namespace pitwall::telemetry

// The operator's joystick over the radio: it can only make the car slower, and only while fresh
// samples of a live hand arrive.
//   in     base: samples of the input device as they are read. Car: the fields of Group::kJoystick
//          of each packet, and how old the packet is
//   out    base: fields for the next packet. Car: throttle cap and brake demand, or nothing
//   invariants
//          dead after 200 ms without a newer sample number, whatever packets say meanwhile: a
//          repeated last value is no sample. A sample older than 100 ms when it is sent, or 200 ms
//          when it is used (way and queue included), is none. Nothing here can raise the throttle
//          there is no way to make a sample but from a device
//          a number from far ahead locks nobody out: once its sample is dead, any number is new
//   units  throttle cap and brake 0 .. 1
//   errors a sample that is no number is no sample; one out of range counts as its end
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "protocol/telemetry/packet/received.hpp"
#include "protocol/telemetry/registry/snapshot.hpp"
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
  void sample(const JoystickSample& sample, Instant at);  // the device spoke
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
  // `received.sent_earliest` unset: the clocks are not compared, the sample is not used.
  void receive(const Values& values, const Received& received);
  std::optional<JoystickSample> sample(Instant now) const;
  // The time of the sample that sample() gives, on the car's clock, never later than the truth.
  std::optional<Instant> sampled_at() const { return taken_at_; }
  void base_restarted();
  const JoystickCounters& counters() const { return counters_; }

 private:
  bool alive(Instant now) const { return taken_at_ && now - *taken_at_ <= kJoystickDead; }

  JoystickSample newest_;
  std::uint16_t number_ = 0;
  std::optional<Instant> taken_at_;  // the sample's own time, on the car's clock
  JoystickCounters counters_;
};

}  // namespace pitwall::telemetry

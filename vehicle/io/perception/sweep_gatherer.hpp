// Which sweeps of several LiDARs make one frame, and when: no sensor is waited for that is late.
//   in     arrived(): a sweep of a sensor, with the time at which it began
//   out    due(): the sweeps of the frame that is due
//   law    a frame is due when each sensor that is alive has its sweep in it, or kWait after its
//          first; a sensor is alive for kAlive after its newest sweep. A sweep is in one frame at
//          most, and no two of one sensor are in one frame
//          The published way, for comparison: a frame has a sweep of every sensor, those within
//          kTogether of each other; a sweep that waits until its sensor's next one is in no frame
//   errors none: the caller asks must_take_before() first when a sweep arrives
//   source message_filters: a synchronizer of exact or approximate time
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "protocol/vocabulary/time.hpp"

namespace pitwall::io {

enum class Gathering : std::uint8_t { kPunctual, kAll };

class SweepGatherer {
 public:
  // LiDARs that turn together send within a few ms.
  static constexpr Duration kWait = milliseconds(12);
  static constexpr Duration kAlive = milliseconds(175);  // three sweeps at 20 Hz were missed

  static constexpr Duration kTogether = milliseconds(25);

  explicit SweepGatherer(std::size_t sensors, Gathering gathering = Gathering::kPunctual)
      : sensors_(sensors), gathering_(gathering) {}

  void arrived(std::size_t sensor, Instant begun, Instant now);
  // Whether the frame is to be taken before a sweep of this sensor can arrive: it has one of it.
  bool must_take_before(std::size_t sensor) const {
    return gathering_ == Gathering::kPunctual && sensors_[sensor].begun.has_value();
  }
  bool is_due(Instant now) const;

  struct Frame {
    Instant begun;                     // of its first sweep
    std::vector<std::size_t> sensors;  // in it
  };
  // The frame that is begun, due or not; none if there is no sweep. The next one then begins.
  std::optional<Frame> take();
  Instant begun(std::size_t sensor) const { return sensors_[sensor].taken; }  // in the last frame

 private:
  struct Sensor {
    std::optional<Instant> begun;  // of the sweep that waits
    std::optional<Instant> received_at;
    Instant taken{};
  };
  bool is_alive(const Sensor& sensor, Instant now) const {
    return sensor.received_at && now - *sensor.received_at <= kAlive;
  }

  bool is_whole() const;

  std::vector<Sensor> sensors_;
  Gathering gathering_;
  std::optional<Instant> first_;  // arrival of the frame's first sweep
};

}  // namespace pitwall::io

// Field of a run: every car on the track in truth, ours and the others.
//   in     all cars at every step of the rig, in the same order
//   out    the first contact of each pair of cars with its cause; the smallest gap of each car to
//          another; the rival of each car as race control's timing has it
//   units  in the names; gaps are those of the rectangles around the cars
//   cost   O(cars^2); after the first step it allocates for a contact only
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "hil/bench/rig.hpp"
#include "hil/nodes/race_control.hpp"
#include "hil/traffic/car_pose.hpp"
#include "hil/traffic/contact_cause.hpp"
#include "hil/traffic/motion_trace.hpp"
#include "vehicle/world/track_map.hpp"

namespace pitwall::bench {

struct FieldCar {
  traffic::CarPose pose{};
  std::uint32_t laps = 0;
  bool told_to_slow = false;  // by race control
};

struct FieldContact {
  std::size_t first = 0, second = 0;  // cars, first < second
  traffic::Contact contact{};
  double s_m = kUnset;  // station on the track

  // Whether this car, one of the two, caused it; alone or with the other one.
  bool is_caused_by(std::size_t car) const;
};

class Field {
 public:
  // `numbers` of the cars, as race control has them.
  Field(const world::TrackMap& track, std::vector<std::uint8_t> numbers);

  void step(std::span<const FieldCar> cars, Instant now);

  const std::vector<FieldContact>& contacts() const { return contacts_; }
  // Unset as long as no other car was within kNear_m.
  double least_gap_m(std::size_t car) const { return least_gap_m_[car]; }
  // The nearest other car along the track; none for a car that is alone.
  std::optional<race::Rival> rival_of(std::size_t car) const;

 private:
  static constexpr double kNear_m = 20.0;  // between the centres: two cars are shorter
  void judge_pair(std::size_t first, std::size_t second, Instant now);
  double progress_m(std::size_t car) const;

  const world::TrackMap& track_;
  std::vector<std::uint8_t> numbers_;
  std::vector<FieldCar> cars_;
  std::vector<traffic::MotionTrace> traces_;
  std::vector<double> least_gap_m_;
  std::vector<FieldContact> contacts_;
};

// The true car of a rig.
FieldCar car_of(const Rig& rig);

}  // namespace pitwall::bench

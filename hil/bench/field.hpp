// Field of a run: every car on the track in truth, those with a stack and the ghosts.
//   in     the cars with a stack at every step of the rig, in the same order; the field moves the
//          ghosts itself, by the station of the first car
//   out    the first contact of each pair of cars with its cause; the smallest gap of each car to
//          another; the rival of each car as race control's timing has it
//   invariants
//          ghosts pass through each other: only a car with a stack has contacts and gaps
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

#include "hil/bench/outcome.hpp"
#include "hil/bench/rig.hpp"
#include "hil/nodes/race_control.hpp"
#include "hil/plant/car_pose.hpp"
#include "hil/sensors/detections.hpp"
#include "hil/traffic/contact_cause.hpp"
#include "hil/traffic/ghost.hpp"
#include "hil/traffic/motion_trace.hpp"
#include "protocol/vocabulary/check.hpp"
#include "protocol/vocabulary/fixed_vector.hpp"
#include "vehicle/pipeline/setup.hpp"
#include "vehicle/world/track_map.hpp"

namespace pitwall::bench {

// A car of the run before its first step.
struct Runner {
  const scenario::Scenario& scenario;
  const pipeline::Setup& setup;
  std::string name;
};

// What keeps a car from sharing the run of the first one: another track, duration or tick, other
// flags of race control.
std::optional<Problem> difference(const Runner& first, const Runner& car);

// A car of the run without a stack.
struct FieldGhost {
  std::string name;
  std::uint8_t number = 0;
  traffic::Ghost ghost{};
};

struct FieldCar {
  plant::CarPose pose{};
  std::uint32_t laps = 0;
  bool told_to_slow = false;  // by race control
};

inline constexpr std::size_t kFieldMax = sensors::kTrueCarsMax;

struct FieldContact {
  std::size_t first = 0, second = 0;  // cars, first < second
  traffic::Contact contact{};
  double s_m = kUnset;  // station on the track
  plant::CarPose first_pose{}, second_pose{};

  // Whether this car, one of the two, caused it; alone or with the other one.
  bool is_caused_by(std::size_t car) const;
};

class Field {
 public:
  // At least one runner. Ghosts come after them in the order of the cars.
  Field(std::span<const Runner> runners, std::span<const FieldGhost> ghosts);

  void step(std::span<const FieldCar> stacks, Instant now);

  std::size_t size() const { return cars_.size(); }
  const FieldCar& car(std::size_t i) const { return cars_[i]; }
  std::uint8_t number(std::size_t i) const { return numbers_[i]; }
  bool is_ghost(std::size_t i) const { return i >= cars_.size() - ghosts_.size(); }
  // Of a car of this name; there is one.
  std::size_t index_of(const std::string& name) const;
  // Lane and speed of a ghost from the next step on.
  void order(std::size_t ghost, const traffic::GhostOrder& order);
  // All cars, by number and name: an order that does not depend on that of the runners.
  std::span<const std::size_t> in_order() const { return in_order_; }
  // All cars but this one in that order, as its sensors may see them; valid until the next call.
  std::span<const plant::CarPose> others_of(std::size_t car);

  const std::vector<FieldContact>& contacts() const { return contacts_; }
  // Unset as long as no other car was within kNear_m.
  double least_gap_m(std::size_t car) const { return least_gap_m_[car]; }
  // The first contact of a car.
  std::optional<CarContact> contact_of(std::size_t car) const;
  // The nearest other car along the track; none for a car that is alone.
  std::optional<race::Rival> rival_of(std::size_t car) const;

 private:
  static constexpr double kNear_m = 20.0;  // between the centres: two cars are shorter
  void judge_pair(std::size_t first, std::size_t second, Instant now);
  double progress_m(std::size_t car) const;
  void move_ghosts(Instant now);

  const world::TrackMap& track_;
  std::vector<std::string> names_;
  std::vector<std::uint8_t> numbers_;  // as race control has them
  std::vector<std::size_t> in_order_;
  std::vector<FieldCar> cars_;
  std::vector<traffic::MotionTrace> traces_;
  std::vector<double> least_gap_m_;
  std::vector<FieldContact> contacts_;
  std::span<const FieldGhost> ghosts_;
  std::vector<traffic::GhostState> ghost_states_;
  std::vector<std::optional<traffic::GhostOrder>> orders_;  // of the ghosts
  FixedVector<plant::CarPose, sensors::kTrueCarsMax> others_;
};

// The true car of a rig.
FieldCar car_of(const Rig& rig);

// Every car shows itself, and then sees the others. For cars with rig() and show_others().
template <class Cars>
void step_field(Field& field, const Cars& cars, Instant at) {
  if (field.size() < 2) return;
  FixedVector<FieldCar, kFieldMax> places;
  for (const auto& car : cars) CHECK(places.push(car_of(car->rig())));
  field.step(places.span(), at);
  for (std::size_t i = 0; i < cars.size(); ++i) cars[i]->show_others(field, i, at);
}

}  // namespace pitwall::bench

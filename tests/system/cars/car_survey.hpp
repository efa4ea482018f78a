// Survey of the stops of a family of cars: every car, place and kind of stop, in several processes.
//   in     cars, places, number of processes
//   out    figures of every stop; the table of margins and the worst ten
//   errors row_of() names car, place, kind and reason of a failed stop
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "tests/hil/plant/family/car_family.hpp"
#include "tests/system/cars/car_stops.hpp"

namespace pitwall::testing {

struct SurveyedStop {
  std::size_t car = 0;
  StopPlace place;
  CarStop kind = CarStop::kControlled;
  double asked_mps = kUnset;
  CarStopFigures figures;
};

std::vector<SurveyedStop> survey(std::span<const plant::FamilyCar> cars,
                                 std::span<const StopPlace> places, unsigned processes);

std::string row_of(const plant::FamilyCar& car, const SurveyedStop& stop);
// Prints the table; returns the number of failed stops.
std::size_t print_survey(std::span<const plant::FamilyCar> cars,
                         std::span<const SurveyedStop> stops);

// The cars of the plant files, then random ones.
std::vector<plant::FamilyCar> family_of(std::uint64_t seed, std::size_t count);

}  // namespace pitwall::testing

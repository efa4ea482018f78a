// Stops of a family of cars from speed: `./pitwall long cars`.
// Exit: 0 every stop passes, 1 one fails, 2 the command line is wrong.
// SPDX-License-Identifier: Apache-2.0
#include <CLI/CLI.hpp>
#include <cstdio>

#include "tests/system/cars/car_survey.hpp"

int main(int argc, char** argv) {
  using namespace pitwall;
  using namespace pitwall::testing;
  std::size_t count = 60, only = 0;
  std::uint64_t seed = 1;
  unsigned processes = 2;
  std::string trace, track;
  bool all = false;
  CLI::App app{"Stops of a family of simulated cars from speed, in lockstep."};
  app.add_option("--cars", count, "how many, with those of the plant files")
      ->check(CLI::Range(1, 10'000));
  app.add_option("--seed", seed, "of what is drawn");
  app.add_option("--processes", processes, "at once")->check(CLI::Range(1, 256));
  app.add_option("--only", only, "one car by its number, from 1");
  app.add_option("--track", track, "lvms, ims or tms alone")
      ->check(CLI::IsMember({"lvms", "ims", "tms"}));
  app.add_flag("--all", all, "print every stop");
  app.add_option("--trace", trace, "write the course of each stop to files that begin so");
  CLI11_PARSE(app, argc, argv);

  std::vector<plant::FamilyCar> cars = family_of(seed, count);
  if (only > cars.size())
    return std::fprintf(stderr, "--only: there are %zu cars\n", cars.size()), 2;
  if (only > 0) cars = {cars[only - 1]};
  std::vector<StopPlace> places;
  for (const StopPlace& place : kStopPlaces)
    if (track.empty() || place.track == track) places.push_back(place);
  std::printf("simulated: %zu cars, seed %llu, %zu places\n", cars.size(),
              static_cast<unsigned long long>(seed), places.size());
  for (const plant::FamilyCar& car : cars) std::printf("  %s\n", to_string(car).c_str());
  if (!trace.empty()) {
    for (const StopPlace& place : places) {
      CarStopResults results;
      run_car_stops({cars[0].params, place, speed_of(cars[0].params, place.track)}, results,
                    trace + "." + place.track + (place.turn ? ".turn" : ".straight"));
    }
    return 0;
  }
  const std::vector<SurveyedStop> stops = survey(cars, places, processes);
  if (all)
    for (const SurveyedStop& stop : stops)
      std::printf("%s\n", row_of(cars[stop.car], stop).c_str());
  const std::size_t failed = print_survey(cars, stops);
  std::printf("%zu of %zu stops fail\n", failed, stops.size());
  return failed == 0 ? 0 : 1;
}

// A fault that is planted into the car, in a corner of what the scenario allows.
// SPDX-License-Identifier: Apache-2.0
#include "hil/cli/sweep/falsifier.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <string>

#include "protocol/transport/file.hpp"

namespace pitwall::cli {
namespace {

constexpr const char* kLaunch = "hil/scenarios/launch.yaml";
constexpr double kBad_m = 2'263.0, kBadWidth_m = 25.0;  // station

// The start from standstill, anywhere on a kilometre and with any mass: the car has to reach a
// speed.
SweepInputs inputs() {
  std::string text =
      transport::read_file(std::string(PITWALL_SOURCE_DIR) + "/" + kLaunch).value_or("");
  text = text.substr(0, text.find("expect:")) +
         "expect:\n  - {kind: within, signal: speed_mps, is: \">\", value: 8, from_s: 1, "
         "until_s: 21}\n";
  sweep::Plan plan{.name = "x", .scenario_file = kLaunch, .seed = 7};
  plan.parameters = {{.path = "duration_s", .values = {"22"}},
                     {.path = "start.s_m", .from = 1'500.0, .to = 2'440.0},
                     {.path = "perturb.mass_kg", .from = -100.0, .to = 100.0}};
  return {sweep::Cases{plan}, "", text};
}

double value_of(const sweep::Case& found, const std::string& path) {
  for (const yaml::Setting& setting : found.settings)
    if (setting.path == path) return std::strtod(setting.value.c_str(), nullptr);
  ADD_FAILURE() << path;
  return kUnset;
}

// A car that is told to go slowly, the more the nearer it stands to a place.
pipeline::Outputs slow_about_a_place(const pipeline::Setup& setup, pipeline::Car& car,
                                     const pipeline::Inputs& in) {
  pipeline::Inputs spoilt = in;
  const double s_m = car.station_m;
  if (!std::isnan(s_m))
    spoilt.operator_speed_limit_mps =
        20.0 - 17.0 * std::exp(-0.5 * std::pow((s_m - kBad_m) / kBadWidth_m, 2));
  return pipeline::step(setup, car, spoilt);
}

TEST(Falsifier, ASoundCarIsNotFalsified) {
  const sweep::Case some{.number = 0, .settings = {{"duration_s", "22"}}};
  EXPECT_EQ(run_case(inputs(), some).verdict, sweep::CaseVerdict::kPassed)
      << "or nothing is judged";
  EXPECT_FALSE(falsify(inputs(), {.runs = 4, .threads = 2}));
}

TEST(Falsifier, AFaultThatIsPlantedInACornerIsFound) {
  const auto found = falsify(inputs(), {.runs = 60, .threads = 2, .step = slow_about_a_place});
  ASSERT_TRUE(found);
  EXPECT_NEAR(value_of(*found, "start.s_m"), kBad_m, 3.0 * kBadWidth_m);
}

}  // namespace
}  // namespace pitwall::cli

// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <string>

#include "tests/vehicle/parameters/mutation.hpp"
#include "vehicle/parameters/car_file.hpp"

namespace pitwall::parameters {
namespace {

using pipeline::CarParams;
using testing::av21;
using testing::refusal;
using testing::Reported;
using testing::with;

Reported radio(const CarParams& p) {
  const safety::LinkLossParams& link_loss = p.radio.link_loss;
  Reported reported{
      {"radio.ladder.joystick_dropped_s", link_loss.joystick_dropped.seconds()},
      {"radio.ladder.override_gone_s", link_loss.override_gone.seconds()},
      {"radio.ladder.no_comm_s", link_loss.no_comm.seconds()},
      {"radio.ladder.no_comm_speed_mps", link_loss.no_comm_speed_mps},
  };
  for (std::size_t i = 0; i < p.radio.paths.size(); ++i) {
    const std::string index = "[" + std::to_string(i) + "]";
    reported["radio.bytes_per_s" + index] = p.radio.paths[i].bytes_per_s;
    reported["radio.packets_per_s" + index] = p.radio.paths[i].packets_per_s;
    reported["radio.safety_bytes_per_s" + index] = p.radio.paths[i].safety_bytes_per_s;
  }
  return reported;
}

CarParams params(const std::string& text) {
  auto car = read_car(text, "car.yaml");
  return car ? car->params : throw std::runtime_error(to_string(car.error()));
}

TEST(RadioSection, EachNumberMovesItsOwnParameter) {
  testing::expect_each_number_to_move_its_own("radio", radio);
}

TEST(RadioSection, ReadsPathsAndFlags) {
  const CarParams car = params(av21());
  ASSERT_EQ(car.radio.paths.size(), 2U);
  EXPECT_EQ(car.radio.paths[0].bytes_per_s, 32'000.0);
  EXPECT_EQ(car.radio.paths[1].packets_per_s, 100.0);
  EXPECT_EQ(car.radio.paths[1].safety_bytes_per_s, 4'400.0);
  EXPECT_FALSE(car.radio.signed_only);
  EXPECT_TRUE(params(with(av21(), "signed_only: false", "signed_only: true")).radio.signed_only);
  EXPECT_TRUE(car.radio.link_loss.no_comm_drives);
  EXPECT_FALSE(params(with(av21(), "no_comm_drives: true", "no_comm_drives: false"))
                   .radio.link_loss.no_comm_drives);
}

TEST(RadioSection, RungsStandInTheirOrderAndSharesInTheirRate) {
  const auto refused = [](const char* what, const char* by, const char* key) {
    const std::string why = refusal(with(av21(), what, by));
    EXPECT_NE(why.find(key), std::string::npos) << by << ": " << why;
  };
  refused("joystick_dropped_s: 0.2", "joystick_dropped_s: 0.5", "override_gone_s");
  refused("override_gone_s: 0.5", "override_gone_s: 1.0", "no_comm_s");
  refused("no_comm_s: 1.0", "no_comm_s: 3.0", "no_comm_s");
  refused("bad_s: 3.0", "bad_s: 1.0", "bad_s");  // below its own warning
  refused("no_comm_speed_mps: 60", "no_comm_speed_mps: 0", "no_comm_speed_mps");
  refused("safety_bytes_per_s: [4400, 4400]", "safety_bytes_per_s: [4400, 32000]",
          "safety_bytes_per_s");
  refused("safety_bytes_per_s: [4400, 4400]", "safety_bytes_per_s: [4400]", "safety_bytes_per_s");
  refused("packets_per_s: [100, 100]", "packets_per_s: [100, 100, 100]", "packets_per_s");
}

}  // namespace
}  // namespace pitwall::parameters

// A CarIo needs a CAN interface, which a host may lack: what is tested here is that it refuses to
// open and says why. Reading, writing and reporting run in tests/system/vcan, where CAN is.
// SPDX-License-Identifier: Apache-2.0
#include "vehicle/io/car_io.hpp"

#include <gtest/gtest.h>

#include <string>

namespace pitwall::io {
namespace {

Arguments somewhere() {
  Arguments args;
  args.can_interface = "pwnone0";
  return args;
}

std::string rim_refusal(const Arguments& args) {
  const auto car_io = CarIo::open(args);
  return car_io ? std::string{} : to_string(car_io.error());
}

TEST(CarIo, RefusesAnInterfaceThatIsNotThere) {
  const std::string why = rim_refusal(somewhere());
  EXPECT_EQ(why.rfind("pwnone0", 0), 0u) << why;
}

TEST(CarIo, RefusesNamesThatNoInterfaceCanHave) {
  for (const char* name : {"", "a name that is much too long for an interface", "can0/..", " "}) {
    Arguments args = somewhere();
    args.can_interface = name;
    EXPECT_FALSE(rim_refusal(args).empty()) << name;
  }
}

}  // namespace
}  // namespace pitwall::io

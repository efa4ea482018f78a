// A Rim needs a CAN interface, which a host may lack: what is tested here is that it refuses to
// open and says why. Reading, writing and reporting run in tests/system/vcan, where CAN is.
// SPDX-License-Identifier: Apache-2.0
#include "vehicle/io/rim.hpp"

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
  const auto rim = Rim::open(args);
  return rim ? std::string{} : to_string(rim.error());
}

TEST(Rim, RefusesAnInterfaceThatIsNotThere) {
  const std::string why = rim_refusal(somewhere());
  EXPECT_EQ(why.rfind("pwnone0", 0), 0u) << why;
}

TEST(Rim, RefusesNamesThatNoInterfaceCanHave) {
  for (const char* name : {"", "a name that is much too long for an interface", "can0/..", " "}) {
    Arguments args = somewhere();
    args.can_interface = name;
    EXPECT_FALSE(rim_refusal(args).empty()) << name;
  }
}

}  // namespace
}  // namespace pitwall::io

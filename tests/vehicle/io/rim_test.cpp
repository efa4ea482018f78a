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
  args.gnss_ports = {0, 0};
  return args;
}

std::string refusal(const Arguments& args) {
  const auto rim = Rim::open(args);
  return rim ? std::string{} : to_string(rim.error());
}

TEST(Rim, RefusesAnInterfaceThatIsNotThere) {
  const std::string why = refusal(somewhere());
  EXPECT_EQ(why.rfind("pwnone0", 0), 0u) << why;
}

TEST(Rim, RefusesNamesThatNoInterfaceCanHave) {
  for (const char* name : {"", "a name that is much too long for an interface", "can0/..", " "}) {
    Arguments args = somewhere();
    args.can_interface = name;
    EXPECT_FALSE(refusal(args).empty()) << name;
  }
}

// Before anything is opened: the address is checked first.
TEST(Rim, RefusesARadioAddressThatIsNone) {
  for (const char* radio : {"", "nowhere", "256.0.0.1:5", "127.0.0.1:", "127.0.0.1:70000",
                            "127.0.0.1:-1", "localhost:23431", "127.0.0.1:23431x", ":"}) {
    Arguments args = somewhere();
    args.radio = radio;
    const std::string why = refusal(args);
    EXPECT_FALSE(why.empty()) << radio;
    EXPECT_EQ(why.find("pwnone0"), std::string::npos) << radio << ": " << why;
    EXPECT_NE(why.find(radio), std::string::npos) << why;
  }
}

}  // namespace
}  // namespace pitwall::io

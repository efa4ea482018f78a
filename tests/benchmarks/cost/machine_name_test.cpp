// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/cost/machine_name.hpp"

#include <gtest/gtest.h>

namespace pitwall::cost {
namespace {

TEST(MachineName, SaysProcessorCoresAndKernel) {
  EXPECT_EQ(machine_name("processor\t: 0\nmodel name\t: AMD EPYC\nflags\t: fpu\n\n"
                         "processor\t: 1\nmodel name\t: AMD EPYC\n",
                         "6.18.44\n"),
            "AMD EPYC, 2 cores, Linux 6.18.44");
  EXPECT_EQ(machine_name("processor: 0\nmodel name : x: y\n", "5.10"), "x: y, 1 core, Linux 5.10");
}

// As on processors that have no name in /proc/cpuinfo.
TEST(MachineName, WhatIsNotToldIsUnknown) {
  EXPECT_EQ(machine_name("processor : 0\nprocessor : 1\nBogoMIPS : 50\n", ""),
            "unknown processor, 2 cores, Linux unknown");
}

TEST(MachineName, OfThisOneIsRead) {
  const std::string name = machine_name();
  EXPECT_EQ(name.find("0 cores"), std::string::npos) << name;
  EXPECT_EQ(name.find("Linux unknown"), std::string::npos) << name;
}

}  // namespace
}  // namespace pitwall::cost

// SPDX-License-Identifier: Apache-2.0
#include "protocol/gnss/novatel_names.hpp"

#include <gtest/gtest.h>

namespace pitwall::gnss {
namespace {

TEST(NovatelNames, EveryNameStandsForOneNumber) {
  for (const Kind kind :
       {Kind::kSolution, Kind::kPosition, Kind::kInsStatus, Kind::kDatum, Kind::kClock, Kind::kUtc,
        Kind::kImuType, Kind::kProfile, Kind::kAlignment, Kind::kOutputFrame, Kind::kOffsetFrame,
        Kind::kOffset, Kind::kOffsetSource, Kind::kTruth}) {
    int named = 0;
    for (std::uint32_t value = 0; value < 256; ++value) {
      const std::string_view name = name_of(kind, value);
      if (name.empty()) continue;
      ++named;
      EXPECT_EQ(value_of(kind, name), value) << name;
    }
    EXPECT_GE(named, 2);
  }
  for (unsigned status = 0; status < 256; ++status) {
    const std::string_view name = time_status_name(static_cast<std::uint8_t>(status));
    if (name.empty()) continue;
    EXPECT_EQ(time_status_value(name), status);
  }
}

// The manual's tables; 50, 16, 53 and 61 also as in the vendor's decodes of the recordings.
TEST(NovatelNames, AreThoseOfTheManual) {
  EXPECT_EQ(name_of(Kind::kPosition, 50), "NARROW_INT");
  EXPECT_EQ(name_of(Kind::kPosition, 16), "SINGLE");
  EXPECT_EQ(name_of(Kind::kPosition, 53), "INS_PSRSP");
  EXPECT_EQ(name_of(Kind::kPosition, 56), "INS_RTKFIXED");
  EXPECT_EQ(name_of(Kind::kSolution, 0), "SOL_COMPUTED");
  EXPECT_EQ(name_of(Kind::kSolution, 1), "INSUFFICIENT_OBS");
  EXPECT_EQ(name_of(Kind::kInsStatus, 3), "INS_SOLUTION_GOOD");
  EXPECT_EQ(name_of(Kind::kDatum, 61), "WGS84");
  EXPECT_EQ(time_status_name(180), "FINESTEERING");
  EXPECT_EQ(log_id("HEADING2"), 1335);
  EXPECT_EQ(log_id("IMURATECORRIMUS"), 1362);
  EXPECT_EQ(log_id("INSSTDEVS"), 2052);
  EXPECT_EQ(name_of(Kind::kOffset, 11), "RBV");
  EXPECT_EQ(name_of(Kind::kOffsetSource, 4), "FROM_COMMAND");
}

TEST(NovatelNames, WhatTheTablesDoNotHaveIsNotMadeUp) {
  EXPECT_EQ(name_of(Kind::kPosition, 255), "");
  EXPECT_EQ(name_of(Kind::kNumber, 0), "");
  EXPECT_FALSE(value_of(Kind::kSolution, "NARROW_INT"));
  EXPECT_FALSE(value_of(Kind::kSolution, ""));
  EXPECT_FALSE(log_id("BESTPOSA"));
  EXPECT_FALSE(time_status_value("finesteering"));
}

TEST(NovatelNames, PortsHaveVirtualPorts) {
  for (unsigned port = 0; port < 256; ++port) {
    const auto name = port_name(static_cast<std::uint8_t>(port));
    if (!name) continue;
    std::string text{name->name};
    if (name->virtual_port != 0) text += "_" + std::to_string(name->virtual_port);
    EXPECT_EQ(port_value(text), port) << text;
  }
  EXPECT_EQ(port_value("COM1"), 0x20);
  EXPECT_EQ(port_value("COM2_31"), 0x5F);
  for (const char* no_port : {"", "COM", "COM1_", "COM1_32", "COM1_x", "USB1", "UNKNOWN"}) {
    EXPECT_FALSE(port_value(no_port)) << no_port;
  }
}

}  // namespace
}  // namespace pitwall::gnss

// SPDX-License-Identifier: Apache-2.0
#include "hil/cli/dbc/signal_name.hpp"

#include <gtest/gtest.h>

#include "protocol/can/dbc_parser.hpp"

namespace pitwall::cli {
namespace {

can::Database some_database() {
  auto database = can::parse_dbc(R"(VERSION ""
BU_: Car
BO_ 1 Brakes: 8 Car
 SG_ FrontPressure : 0|8@1+ (1,0) [0|0] "" Car
 SG_ RearPressure : 8|8@1+ (1,0) [0|0] "" Car
BO_ 2 Engine: 8 Car
 SG_ Speed : 0|8@1+ (1,0) [0|0] "" Car
)",
                                 "t.dbc");
  CHECK(database);
  return *std::move(database);
}

TEST(FindSignal, IsByMessageAndSignal) {
  const can::Database database = some_database();
  const auto found = find_signal(database, "Brakes.RearPressure");
  ASSERT_TRUE(found);
  EXPECT_EQ(found->message->id, 1u);
  EXPECT_EQ(found->signal->layout.start, 8);
}

TEST(FindSignal, WhatIsNotThereIsToldWithTheNearestNames) {
  const can::Database database = some_database();
  const auto reported = [&database](const char* words) {
    const auto found = find_signal(database, words);
    return found ? std::string("found") : to_string(found.error());
  };
  EXPECT_NE(reported("brake.Speed").find("no message \"brake\"; the nearest: Brakes, Engine"),
            std::string::npos)
      << reported("brake.Speed");
  EXPECT_NE(reported("Brakes.RaerPresure")
                .find("no signal \"RaerPresure\"; the nearest: Brakes.RearPressure, Brakes.Front"),
            std::string::npos)
      << reported("Brakes.RaerPresure");
  for (const char* const words : {"", ".", "Brakes", "Brakes.", ".Speed"})
    EXPECT_NE(reported(words).find("expected MESSAGE.SIGNAL"), std::string::npos) << words;
}

TEST(EditDistance, IsThatOfLevenshtein) {
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3u);
  EXPECT_EQ(edit_distance("", "abc"), 3u);
  EXPECT_EQ(edit_distance("abc", ""), 3u);
  EXPECT_EQ(edit_distance("Speed", "sPEED"), 0u);
}

}  // namespace
}  // namespace pitwall::cli

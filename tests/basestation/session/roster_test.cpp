// SPDX-License-Identifier: Apache-2.0
#include "basestation/session/roster.hpp"

#include <gtest/gtest.h>

namespace pitwall::session {
namespace {

TEST(Roster, SaysEachCarInTheOrderOfItsTab) {
  EXPECT_EQ(roster_text({{.number = 8, .name = "Red \"2\"", .mode = "REAL", .link = "lost"},
                         {.number = 7, .name = "", .mode = "NONE"}}),
            R"({"cars": [{"number": 8, "name": "Red \"2\"", "mode": "REAL", "link": "lost"}, )"
            R"({"number": 7, "name": "", "mode": "NONE", "link": null}]})");
  EXPECT_EQ(roster_text({}), R"({"cars": []})");
}

TEST(Roster, LooksTwiceASecond) {
  auto web = publishers::web::WebServer::start({}, {});
  ASSERT_TRUE(web);
  int looks = 0;
  Roster roster{**web, [&] {
                  ++looks;
                  return std::vector<CarStatus>{{.number = looks}};
                }};
  for (Instant now{seconds(9).ns}; now < Instant{seconds(10).ns}; now = now + milliseconds(10)) {
    roster.serve(now);
    EXPECT_GT(roster.due(), now);
  }
  EXPECT_EQ(looks, 2);
}

}  // namespace
}  // namespace pitwall::session

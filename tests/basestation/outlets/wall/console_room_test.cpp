// SPDX-License-Identifier: Apache-2.0
#include "basestation/outlets/wall/console_room.hpp"

#include <gtest/gtest.h>

#include "protocol/json/json_value.hpp"
#include "tests/basestation/outlets/wall/looking.hpp"
#include "tests/basestation/outlets/wall/now.hpp"

namespace pitwall::outlets::wall {
namespace {

constexpr ClientId kAnna = 16, kGarage = 17;

class Room : public ::testing::Test {
 protected:
  void SetUp() override {
    room_.joined(kAnna, {.role = Role::kOperator, .name = "Anna"}, kNow);
    room_.joined(kGarage, {.role = Role::kViewer, .name = {}}, kNow);
    room_.take();
  }
  // Types of the texts for this client since the last call; "#" for a frame.
  std::vector<std::string> told(ClientId client) {
    std::vector<std::string> types;
    for (const Sending& sending : room_.take()) {
      if (!sending.to.test(client)) continue;
      const auto value = json::JsonValue::parse(sending.message->text, "text");
      types.push_back(sending.message->frame ? "#" : value ? value->text("type") : "NO JSON");
    }
    return types;
  }
  std::optional<Request> says(ClientId client, const std::string& text) {
    return room_.said(client, text, eyes_, kNow);
  }
  using Types = std::vector<std::string>;

  Looking eyes_;
  ConsoleRoom room_{R"({"type": "catalogue"})"};
};

TEST_F(Room, WhoJoinsIsToldWhoItIsThenWhatThereIs) {
  room_.tell_state("link", R"({"type": "link", "n": 1})", kNow);
  room_.tell_state("link", R"({"type": "link", "n": 2})", kNow);
  for (int i = 0; i < 300; ++i) room_.tell_line("audit", R"({"type": "audit"})", kNow);
  room_.take();
  room_.joined(18, {.role = Role::kViewer, .name = {}}, kNow);
  room_.serve(eyes_, {}, kNow);
  const Types types = told(18);
  ASSERT_EQ(types.size(), 3 + ConsoleRoom::kLines + 1);
  EXPECT_EQ(types[0], "hello");
  EXPECT_EQ(types[1], "catalogue");
  EXPECT_EQ(types[2], "link");
  EXPECT_EQ(types[3], "audit");
  EXPECT_EQ(types.back(), "#");
}

TEST_F(Room, AViewerLooksOnly) {
  EXPECT_FALSE(says(kGarage, R"({"type":"stop","kind":"emergency"})"));
  EXPECT_EQ(told(kGarage), Types{"error"});
  EXPECT_TRUE(says(kAnna, R"({"type":"stop","kind":"emergency"})"));
  EXPECT_TRUE(says(kGarage, R"({"type":"mark","text":"here"})"));
}

TEST_F(Room, AnErrorIsToldToItsConsoleOnly) {
  EXPECT_FALSE(says(kAnna, "{"));
  room_.said_binary(kAnna);
  const auto sendings = room_.take();
  ASSERT_EQ(sendings.size(), 2u);
  for (const Sending& sending : sendings) EXPECT_EQ(sending.to, web::ClientSet{}.set(kAnna));
  EXPECT_EQ(room_.counters().refused, 2u);
}

TEST_F(Room, HistoryIsAFrameForWhoAsked) {
  EXPECT_FALSE(says(kGarage, R"({"type":"history","field":0,"from_s":60,"to_s":0,"points":500})"));
  EXPECT_EQ(told(kGarage), Types{"#"});
  says(kGarage, R"({"type":"history","field":9999,"from_s":60,"to_s":0,"points":500})");
  EXPECT_EQ(told(kGarage), Types{"error"});
}

TEST_F(Room, WhoLeftIsToldNothingAndSaysNothing) {
  room_.left(kAnna);
  EXPECT_FALSE(says(kAnna, R"({"type":"stop","kind":"emergency"})"));
  room_.tell_all("{}");
  for (const Sending& sending : room_.take()) EXPECT_FALSE(sending.to.test(kAnna));
  EXPECT_FALSE(room_.role(kAnna));
  EXPECT_EQ(room_.clients(), 1u);
}

TEST_F(Room, HelloComesAgainWhenTheCarIsMet) {
  room_.identify({.car = 7, .name = "x", .mode = "REAL", .alarm_config = "1"}, kNow);
  EXPECT_EQ(told(kAnna), Types{"hello"});
  room_.identify({.car = 7, .name = "x", .mode = "REAL", .alarm_config = "1"}, kNow);
  EXPECT_EQ(told(kAnna), Types{});
}

TEST_F(Room, TheRecorderGetsTheVeryTexts) {
  std::vector<std::string> kept;
  room_.record_with([&](std::string_view type, std::string_view text, Instant) {
    kept.push_back(std::string{type} + std::string{text});
  });
  room_.tell_line("audit", "{1}", kNow);
  room_.tell_state("fuel", "{2}", kNow);
  EXPECT_EQ(kept, (std::vector<std::string>{"audit{1}", "fuel{2}"}));
}

TEST_F(Room, EachWhoRecordsIsTold) {
  int first = 0, second = 0;
  room_.record_with([&](std::string_view, std::string_view, Instant) { ++first; });
  room_.record_with([&](std::string_view, std::string_view, Instant) { ++second; });
  room_.tell_line("audit", "{1}", kNow);
  EXPECT_EQ(first, 1);
  EXPECT_EQ(second, 1);
}

}  // namespace
}  // namespace pitwall::outlets::wall

// SPDX-License-Identifier: Apache-2.0
#include "basestation/publishers/console/client_registry.hpp"

#include <gtest/gtest.h>

#include "protocol/json/json_value.hpp"
#include "tests/basestation/publishers/console/fake_state_source.hpp"
#include "tests/basestation/publishers/console/now.hpp"

namespace pitwall::publishers::console {
namespace {

constexpr ClientId kAnna = 16, kGarage = 17;

class Clients : public ::testing::Test {
 protected:
  void SetUp() override {
    clients_.joined(kAnna, {.role = Role::kOperator, .name = "Anna"}, kNow);
    clients_.joined(kGarage, {.role = Role::kViewer, .name = {}}, kNow);
    clients_.take();
  }
  // Types of the texts for this client since the last call; "#" for a frame.
  std::vector<std::string> reported(ClientId client) {
    std::vector<std::string> types;
    for (const Sending& sending : clients_.take()) {
      if (!sending.to.test(client)) continue;
      const auto value = json::JsonValue::parse(sending.message->text, "text");
      types.push_back(sending.message->frame ? "#" : value ? value->text("type") : "NO JSON");
    }
    return types;
  }
  std::optional<Request> says(ClientId client, const std::string& text) {
    return clients_.receive_text(client, text, source_, kNow);
  }
  using Types = std::vector<std::string>;

  FakeStateSource source_;
  service::MessageLog messages_;
  ClientRegistry clients_{R"({"type": "catalogue"})", messages_};
};

TEST_F(Clients, WhoJoinsIsToldWhoItIsThenWhatThereIs) {
  messages_.set_state("link", R"({"type": "link", "n": 1})", kNow);
  messages_.set_state("link", R"({"type": "link", "n": 2})", kNow);
  for (int i = 0; i < 300; ++i) messages_.add_line("audit", R"({"type": "audit"})", kNow);
  clients_.take();
  clients_.joined(18, {.role = Role::kViewer, .name = {}}, kNow);
  clients_.serve(source_, {}, kNow);
  const Types types = reported(18);
  ASSERT_EQ(types.size(), 3 + service::MessageLog::kLines + 1);
  EXPECT_EQ(types[0], "hello");
  EXPECT_EQ(types[1], "catalogue");
  EXPECT_EQ(types[2], "link");
  EXPECT_EQ(types[3], "audit");
  EXPECT_EQ(types.back(), "#");
}

TEST_F(Clients, ACrowdThatComesAtOnceSharesWhatItIsTold) {
  messages_.set_state("link", R"({"type": "link"})", kNow);
  for (int i = 0; i < 300; ++i) messages_.add_line("audit", R"({"type": "audit"})", kNow);
  clients_.take();
  constexpr ClientId kFirst = 18, kLast = 217;
  for (ClientId client = kFirst; client <= kLast; ++client)
    clients_.joined(client, {.role = Role::kViewer, .name = {}}, kNow);
  clients_.left(kFirst);
  const auto sendings = clients_.take();
  std::size_t hellos = 0, shared = 0;
  for (const Sending& sending : sendings) {
    EXPECT_FALSE(sending.to.test(kFirst)) << "it has left";
    (sending.to.count() == 1 ? hellos : shared) += 1;
  }
  EXPECT_EQ(hellos, kLast - kFirst);
  EXPECT_EQ(shared, 2 + service::MessageLog::kLines) << "the catalogue, the link, the log";
}

// In the order of what the base says, and once.
TEST_F(Clients, ALineThatIsSaidWhileSomebodyComesIsToldAfterTheEarlierOnes) {
  messages_.subscribe([this](std::string_view, std::string_view text, Instant) {
    clients_.send_to_all(std::string{text});
  });
  messages_.add_line("audit", R"({"type": "audit"})", kNow);
  clients_.take();
  clients_.joined(18, {.role = Role::kViewer, .name = {}}, kNow);
  messages_.add_line("mark", R"({"type": "mark"})", kNow);
  EXPECT_EQ(reported(18), (Types{"hello", "catalogue", "audit", "mark"}));
}

TEST_F(Clients, AViewerLooksOnly) {
  EXPECT_FALSE(says(kGarage, R"({"type":"stop","kind":"emergency"})"));
  EXPECT_EQ(reported(kGarage), Types{"error"});
  EXPECT_TRUE(says(kAnna, R"({"type":"stop","kind":"emergency"})"));
  EXPECT_TRUE(says(kGarage, R"({"type":"mark","text":"here"})"));
}

TEST_F(Clients, AnErrorIsToldToItsConsoleOnly) {
  EXPECT_FALSE(says(kAnna, "{"));
  clients_.receive_binary(kAnna);
  const auto sendings = clients_.take();
  ASSERT_EQ(sendings.size(), 2u);
  for (const Sending& sending : sendings) EXPECT_EQ(sending.to, web::ClientSet{}.set(kAnna));
  EXPECT_EQ(clients_.counters().refused, 2u);
}

TEST_F(Clients, HistoryIsAFrameForWhoAsked) {
  EXPECT_FALSE(says(kGarage, R"({"type":"history","field":0,"from_s":60,"to_s":0,"points":500})"));
  EXPECT_EQ(reported(kGarage), Types{"#"});
  says(kGarage, R"({"type":"history","field":9999,"from_s":60,"to_s":0,"points":500})");
  EXPECT_EQ(reported(kGarage), Types{"error"});
}

TEST_F(Clients, ALapIsAFrameForWhoAsked) {
  EXPECT_FALSE(says(kGarage, R"({"type":"lap","lap":1})"));
  EXPECT_EQ(reported(kGarage), Types{"error"}) << "none was driven";
  source_.state.values[telemetry::field("track.station")] = 100.0;
  source_.state.at(telemetry::Group::kTrack) = kNow;
  telemetry::GroupSet groups;
  groups.add(telemetry::Group::kTrack);
  source_.laps_driven.note(source_.state, groups);
  EXPECT_FALSE(says(kGarage, R"({"type":"lap","lap":1})"));
  const auto sendings = clients_.take();
  ASSERT_EQ(sendings.size(), 1U);
  EXPECT_EQ(sendings[0].to, web::ClientSet{}.set(kGarage));
  ASSERT_TRUE(sendings[0].message->frame);
  EXPECT_EQ(sendings[0].message->frame->kind, web::FrameKind::kLap);
}

TEST_F(Clients, WhoLeftIsToldNothingAndSaysNothing) {
  clients_.left(kAnna);
  EXPECT_FALSE(says(kAnna, R"({"type":"stop","kind":"emergency"})"));
  clients_.send_to_all("{}");
  for (const Sending& sending : clients_.take()) EXPECT_FALSE(sending.to.test(kAnna));
  EXPECT_FALSE(clients_.role(kAnna));
  EXPECT_EQ(clients_.clients(), 1u);
}

TEST_F(Clients, HelloComesAgainWhenTheCarIsMet) {
  clients_.identify({.car = 7, .name = "x", .mode = "REAL", .alarm_config = "1"}, kNow);
  EXPECT_EQ(reported(kAnna), Types{"hello"});
  clients_.identify({.car = 7, .name = "x", .mode = "REAL", .alarm_config = "1"}, kNow);
  EXPECT_EQ(reported(kAnna), Types{});
}

}  // namespace
}  // namespace pitwall::publishers::console

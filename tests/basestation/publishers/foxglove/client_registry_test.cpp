// SPDX-License-Identifier: Apache-2.0
#include "basestation/publishers/foxglove/client_registry.hpp"

#include <gtest/gtest.h>

#include "protocol/json/json_value.hpp"

namespace pitwall::publishers::foxglove {
namespace {

constexpr web::ClientId kAnna = 16, kBert = 17;
const std::vector<std::uint8_t> kBody{1, 2, 3};

class FoxgloveRoom : public testing::Test {
 protected:
  static std::vector<ChannelRow> rows() {
    return {{.topic = "/a"}, {.topic = "/b"}, {.topic = "/latched", .latched = true}};
  }
  void SetUp() override {
    clients_.joined(kAnna);
    clients_.joined(kBert);
    clients_.take();
  }
  void subscribe(web::ClientId client, int id, int channel) {
    clients_.receive_text(client, R"({"op":"subscribe","subscriptions":[{"id":)" +
                                      std::to_string(id) + R"(,"channelId":)" +
                                      std::to_string(channel) + "}]}");
  }
  // The statuses that a client was told, in a row.
  std::string statuses(web::ClientId client) {
    std::string all;
    for (const Sending& sending : clients_.take()) {
      if (!sending.to.test(client) || sending.message->text.empty()) continue;
      const auto value = json::JsonValue::parse(sending.message->text, "text");
      if (value->text("op") == "status") all += value->text("message") + "\n";
    }
    return all;
  }
  std::uint64_t refused(const std::string& kind) const {
    for (const auto& [name, count] : clients_.figures().refused) {
      if (name == kind) return count;
    }
    return 0;
  }

  ClientRegistry clients_{{.name = "car", .session = "s"}, rows()};
};

TEST_F(FoxgloveRoom, WhoJoinsIsToldWhatIsServedBeforeAnythingElse) {
  clients_.joined(18);
  const auto out = clients_.take();
  ASSERT_EQ(out.size(), 2U);
  EXPECT_NE(out[0].message->text.find("serverInfo"), std::string::npos);
  EXPECT_NE(out[1].message->text.find("/latched"), std::string::npos);
  EXPECT_TRUE(out[0].to.test(18));
  EXPECT_EQ(out[0].to.count(), 1U);
}

TEST_F(FoxgloveRoom, AMessageGoesToItsSubscribersUnderTheirOwnIds) {
  subscribe(kAnna, 5, 0);
  subscribe(kBert, 9, 0);
  subscribe(kBert, 8, 1);
  clients_.message(0, UtcTime{77}, kBody);
  const auto out = clients_.take();
  ASSERT_EQ(out.size(), 2U);
  for (const Sending& sending : out) {
    const web::Bytes& bytes = *sending.message->binary;
    EXPECT_EQ(bytes.head[1], sending.to.test(kAnna) ? 5 : 9);
    EXPECT_EQ(bytes.head[5], 77);
    EXPECT_EQ(*bytes.body, kBody);
    EXPECT_NE(bytes.tag, 0U);
  }
  EXPECT_EQ(out[0].message->binary->body, out[1].message->binary->body) << "the body is one";
}

TEST_F(FoxgloveRoom, NobodyIsToldWhatHeHasNotSubscribedOrNoMore) {
  EXPECT_FALSE(clients_.wanted(0));
  subscribe(kAnna, 5, 0);
  EXPECT_TRUE(clients_.wanted(0));
  clients_.receive_text(kAnna, R"({"op":"unsubscribe","subscriptionIds":[5]})");
  clients_.message(0, UtcTime{}, kBody);
  EXPECT_TRUE(clients_.take().empty());
  subscribe(kAnna, 5, 0);
  clients_.left(kAnna);
  clients_.message(0, UtcTime{}, kBody);
  EXPECT_TRUE(clients_.take().empty());
}

TEST_F(FoxgloveRoom, OfALatchedChannelWhoComesLateIsToldTheNewest) {
  clients_.message(2, UtcTime{1}, {});
  clients_.message(2, UtcTime{2}, kBody);
  subscribe(kBert, 1, 2);
  const auto out = clients_.take();
  ASSERT_EQ(out.size(), 1U);
  EXPECT_EQ(*out[0].message->binary->body, kBody);
  clients_.forget();
  subscribe(kAnna, 1, 2);
  EXPECT_TRUE(clients_.take().empty());
}

TEST_F(FoxgloveRoom, MistakesOfSubscriptionAreToldAndCounted) {
  subscribe(kAnna, 1, 99);
  EXPECT_NE(statuses(kAnna).find("no channel 99"), std::string::npos);
  subscribe(kAnna, 1, 0);
  subscribe(kAnna, 1, 1);
  EXPECT_NE(statuses(kAnna).find("id is in use"), std::string::npos);
  subscribe(kAnna, 2, 0);
  EXPECT_NE(statuses(kAnna).find("channel 0 is subscribed already"), std::string::npos);
  EXPECT_EQ(refused("subscribe"), 3U);
  clients_.receive_text(kAnna, R"({"op":"unsubscribe","subscriptionIds":[3]})");
  EXPECT_NE(statuses(kAnna).find("no subscription 3"), std::string::npos);
  clients_.receive_text(kAnna, "nonsense");
  EXPECT_EQ(refused("malformed"), 1U);
}

TEST_F(FoxgloveRoom, WhoPublishesOrSetsIsRefusedAndNobodyElseHearsOfIt) {
  clients_.receive_text(kAnna, R"({"op":"advertise","channels":[{"id":1,"topic":"/cmd"}]})");
  clients_.receive_bytes(kAnna, std::vector<std::uint8_t>{1, 0, 0, 0, 0, 'x'});
  clients_.receive_bytes(kAnna, std::vector<std::uint8_t>{2, 0});
  clients_.receive_text(kAnna, R"({"op":"setParameters","parameters":[]})");
  EXPECT_FALSE(clients_.receive_bytes(
      kAnna, std::vector<std::uint8_t>{3, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}));
  for (const Sending& sending : clients_.take()) {
    EXPECT_TRUE(sending.to.test(kAnna));
    EXPECT_EQ(sending.to.count(), 1U);
    EXPECT_NE(sending.message->text.find(R"("level": 2)"), std::string::npos)
        << sending.message->text;
  }
  EXPECT_EQ(refused("clientPublish"), 2U);
  EXPECT_EQ(refused("services"), 1U);
  EXPECT_EQ(refused("setParameters"), 1U);
  EXPECT_EQ(refused("playbackControl"), 1U);
}

TEST_F(FoxgloveRoom, ThresholdsAreReadAndWatched) {
  // Name, value and request of each parameter that a client was told.
  const auto reported = [&](web::ClientId client) {
    std::string all;
    for (const Sending& sending : clients_.take()) {
      if (!sending.to.test(client) || sending.message->text.empty()) continue;
      const auto value = json::JsonValue::parse(sending.message->text, "text");
      for (const auto& row : value->items("parameters"))
        all += row.text("name") + "=" + std::to_string(static_cast<int>(row.number("value"))) +
               value->text("id") + " ";
    }
    return all;
  };
  clients_.receive_text(kAnna, R"({"op":"subscribeParameterUpdates","parameterNames":[]})");
  clients_.parameters({{"/a", 1}, {"/b", 2}});
  EXPECT_EQ(reported(kAnna), "/a=1 /b=2 ") << "all means those to come, too";
  clients_.receive_text(kBert,
                        R"({"op":"getParameters","parameterNames":["/b","/none"],"id":"!"})");
  EXPECT_EQ(reported(kBert), "/b=2! ");
  clients_.receive_text(kBert, R"({"op":"subscribeParameterUpdates","parameterNames":["/b"]})");
  clients_.parameters({{"/a", 1}, {"/b", 3}});
  EXPECT_EQ(reported(kBert), "/b=3 ");
  clients_.parameters({{"/a", 5}, {"/b", 3}});
  EXPECT_EQ(reported(kBert), "") << "not asked for";
  clients_.receive_text(kAnna, R"({"op":"unsubscribeParameterUpdates","parameterNames":[]})");
  clients_.left(kBert);
  clients_.parameters({{"/a", 6}, {"/b", 6}});
  EXPECT_EQ(reported(kAnna), "");
  clients_.receive_text(kAnna, R"({"op":"getParameters","parameterNames":[]})");
  EXPECT_EQ(reported(kAnna), "/a=6 /b=6 ");
}

TEST_F(FoxgloveRoom, TheGraphIsToldToWhoAsks) {
  clients_.receive_text(kAnna, R"({"op":"subscribeConnectionGraph"})");
  clients_.receive_text(kAnna, R"({"op":"unsubscribeConnectionGraph"})");
  const auto out = clients_.take();
  ASSERT_EQ(out.size(), 1U);
  EXPECT_TRUE(out[0].to.test(kAnna));
  EXPECT_NE(out[0].message->text.find("/latched"), std::string::npos);
}

TEST_F(FoxgloveRoom, WhoLosesMessagesIsToldOfWhichTopicsAndHowMany) {
  subscribe(kAnna, 1, 0);
  subscribe(kAnna, 2, 1);
  clients_.message(0, UtcTime{}, kBody);
  const std::uint32_t tag = clients_.take()[0].message->binary->tag;
  const std::vector<web::Drop> drops{{kAnna, tag, 5}, {kAnna, tag + 1, 2}, {kBert, tag, 1}};
  clients_.lost(drops);
  EXPECT_NE(statuses(kAnna).find("/a 5, /b 2"), std::string::npos);
  const auto figures = clients_.figures();
  ASSERT_EQ(figures.dropped.size(), 2U);
  EXPECT_EQ(figures.dropped[0].first, "/a");
  EXPECT_EQ(figures.dropped[0].second, 6U);
  EXPECT_EQ(figures.clients, 2U);
}

TEST_F(FoxgloveRoom, ARecordingIsWoundByItsClients) {
  ClientRegistry room{{.name = "", .session = "", .playback = TimeRange{}}, rows()};
  room.joined(kAnna);
  room.take();
  const auto control = room.receive_bytes(
      kAnna, std::vector<std::uint8_t>{3, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0});
  ASSERT_TRUE(control);
  EXPECT_TRUE(control->play);
  room.playback({});
  EXPECT_EQ(room.take()[0].message->binary->tag, 0U) << "a state of the playback is never lost";
}

TEST_F(FoxgloveRoom, WhoHasLeftIsNotHeard) {
  clients_.left(kBert);
  subscribe(kBert, 1, 0);
  EXPECT_FALSE(clients_.wanted(0));
  EXPECT_TRUE(clients_.take().empty());
}

}  // namespace
}  // namespace pitwall::publishers::foxglove

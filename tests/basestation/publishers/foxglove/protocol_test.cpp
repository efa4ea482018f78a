// SPDX-License-Identifier: Apache-2.0
#include "basestation/publishers/foxglove/protocol.hpp"

#include <gtest/gtest.h>

#include <random>

#include "protocol/json/json_value.hpp"

namespace pitwall::publishers::foxglove {
namespace {

json::JsonValue json_of(const std::string& text) {
  auto value = json::JsonValue::parse(text, "text");
  EXPECT_TRUE(value) << text;
  return value ? *value : json::JsonValue{};
}
std::vector<std::uint8_t> bytes_of(std::initializer_list<int> some) {
  std::vector<std::uint8_t> bytes;
  for (const int byte : some) bytes.push_back(static_cast<std::uint8_t>(byte));
  return bytes;
}
Result<Request, Problem> binary(std::initializer_list<int> some) {
  return parse_binary(bytes_of(some));
}

TEST(FoxgloveProtocol, AServerSaysWhatItCanAndOfARecordingFromWhenToWhen) {
  const auto live = json_of(server_info_text({.name = "car \"7\"", .session = "s"}));
  EXPECT_EQ(live.text("op"), "serverInfo");
  EXPECT_EQ(live.text("name"), "car \"7\"");
  std::vector<std::string> can;
  for (const auto& one : live.items("capabilities")) can.push_back(one.text());
  EXPECT_EQ(can, (std::vector<std::string>{"time", "parameters", "parametersSubscribe",
                                           "connectionGraph"}));
  EXPECT_EQ(live.find("dataStartTime"), nullptr);
  const auto replay = json_of(server_info_text(
      {.name = "", .session = "", .playback = TimeRange{UtcTime{1'500'000'000}, UtcTime{2}}}));
  EXPECT_EQ(replay.items("capabilities").back().text(), "playbackControl");
  EXPECT_EQ(replay.find("dataStartTime")->number("sec"), 1.0);
  EXPECT_EQ(replay.find("dataStartTime")->number("nsec"), 5e8);
  EXPECT_EQ(replay.find("dataEndTime")->number("nsec"), 2.0);
}

TEST(FoxgloveProtocol, AChannelIsAdvertisedWithItsSchema) {
  const std::vector<ChannelRow> rows{{.id = 3,
                                      .topic = "/car/ego",
                                      .encoding = "cdr",
                                      .schema_name = "a/msg/B",
                                      .schema_encoding = "ros2msg",
                                      .schema = "float64 x\n"}};
  const auto text = json_of(advertise_text(rows));
  EXPECT_EQ(text.text("op"), "advertise");
  const auto& row = text.items("channels").at(0);
  EXPECT_EQ(row.number("id"), 3.0);
  EXPECT_EQ(row.text("schema"), "float64 x\n");
  EXPECT_EQ(row.text("schemaName"), "a/msg/B");
}

TEST(FoxgloveProtocol, BinaryMessagesAreLittleEndian) {
  const auto header = message_header(0x01020304, UtcTime{0x0807060504030201});
  EXPECT_EQ((std::vector<std::uint8_t>{header.begin(), header.end()}),
            bytes_of({1, 4, 3, 2, 1, 1, 2, 3, 4, 5, 6, 7, 8}));
  EXPECT_EQ(time_bytes(UtcTime{1}), bytes_of({2, 1, 0, 0, 0, 0, 0, 0, 0}));
  const PlaybackState state{.status = PlaybackStatus::kEnded,
                            .at = UtcTime{12345},
                            .speed = 1.0F,
                            .did_seek = true,
                            .request = "id"};
  EXPECT_EQ(playback_bytes(state), bytes_of({5, 3,    0x39, 0x30, 0, 0, 0, 0, 0,   0,  0,
                                             0, 0x80, 0x3F, 1,    2, 0, 0, 0, 'i', 'd'}));
}

TEST(FoxgloveProtocol, SubscriptionsAreRead) {
  const auto ask = parse_text(R"({"op":"subscribe","subscriptions":[{"id":0,"channelId":5},)"
                              R"({"id":4294967295,"channelId":1}]})");
  ASSERT_TRUE(ask);
  const auto& wanted = std::get<Subscribe>(*ask).wanted;
  ASSERT_EQ(wanted.size(), 2U);
  EXPECT_EQ(wanted[0].channel, 5U);
  EXPECT_EQ(wanted[1].id, 4'294'967'295U);
  const auto end = parse_text(R"({"op":"unsubscribe","subscriptionIds":[7]})");
  EXPECT_EQ(std::get<Unsubscribe>(*end).ids, std::vector<std::uint32_t>{7});
}

TEST(FoxgloveProtocol, WhatWouldChangeAnythingIsNamedByItsCapability) {
  for (const auto& [op, capability] : {std::pair{"advertise", "clientPublish"},
                                       {"setParameters", "setParameters"},
                                       {"fetchAsset", "assets"}}) {
    const auto ask = parse_text(std::string{R"({"op":")"} + op + "\"}");
    ASSERT_TRUE(ask) << op;
    EXPECT_EQ(std::get<Refusable>(*ask).capability, capability);
  }
  EXPECT_EQ(std::get<Refusable>(*binary({1, 0, 0, 0, 0, 'x'})).capability, "clientPublish");
  EXPECT_EQ(std::get<Refusable>(*binary({2})).capability, "services");
}

TEST(FoxgloveProtocol, ParametersAreAskedForAndTold) {
  const auto ask = parse_text(R"({"op":"getParameters","parameterNames":["/a"],"id":"7"})");
  ASSERT_TRUE(ask);
  EXPECT_EQ(std::get<GetParameters>(*ask).names, std::vector<std::string>{"/a"});
  EXPECT_EQ(std::get<GetParameters>(*ask).request, "7");
  const auto evaluator = parse_text(R"({"op":"subscribeParameterUpdates","parameterNames":[]})");
  EXPECT_FALSE(std::get<WatchParameters>(*evaluator).ends);
  const auto ends = parse_text(R"({"op":"unsubscribeParameterUpdates","parameterNames":["/b"]})");
  EXPECT_TRUE(std::get<WatchParameters>(*ends).ends);
  EXPECT_EQ(std::get<WatchParameters>(*ends).names, std::vector<std::string>{"/b"});
  const std::vector<Parameter> parameters{{"/a", 2.5}};
  const auto reported = json_of(parameters_text(parameters, "7"));
  EXPECT_EQ(reported.text("op"), "parameterValues");
  EXPECT_EQ(reported.text("id"), "7");
  EXPECT_EQ(reported.items("parameters").at(0).text("name"), "/a");
  EXPECT_EQ(reported.items("parameters").at(0).number("value"), 2.5);
  EXPECT_EQ(json_of(parameters_text(parameters, "")).find("id"), nullptr);
}

TEST(FoxgloveProtocol, TheGraphHasEveryTopicAndNobodyWhoListens) {
  EXPECT_FALSE(std::get<WatchGraph>(*parse_text(R"({"op":"subscribeConnectionGraph"})")).ends);
  EXPECT_TRUE(std::get<WatchGraph>(*parse_text(R"({"op":"unsubscribeConnectionGraph"})")).ends);
  const std::vector<ChannelRow> rows{{.id = 0, .topic = "/a"}, {.id = 1, .topic = "/b"}};
  const auto graph = json_of(graph_text(rows, "car 7"));
  EXPECT_EQ(graph.text("op"), "connectionGraphUpdate");
  ASSERT_EQ(graph.items("publishedTopics").size(), 2U);
  EXPECT_EQ(graph.items("publishedTopics")[1].text("name"), "/b");
  EXPECT_EQ(graph.items("publishedTopics")[1].items("publisherIds").at(0).text(), "car 7");
  EXPECT_TRUE(graph.items("subscribedTopics").empty());
}

TEST(FoxgloveProtocol, PlaybackIsControlled) {
  const auto ask =
      binary({3, 0, 0, 0, 0, 0x40, 1, 0x15, 0xCD, 0x5B, 7, 0, 0, 0, 0, 2, 0, 0, 0, 'i', 'd'});
  ASSERT_TRUE(ask) << to_string(ask.error());
  const auto& control = std::get<PlaybackControl>(*ask);
  EXPECT_TRUE(control.play);
  EXPECT_EQ(control.speed, 2.0F);
  EXPECT_EQ(control.seek, UtcTime{123'456'789});
  EXPECT_EQ(control.request, "id");
  const auto pause = binary({3, 1, 0, 0, 0, 0, 0, 9, 9, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0});
  ASSERT_TRUE(pause);
  EXPECT_FALSE(std::get<PlaybackControl>(*pause).play);
  EXPECT_FALSE(std::get<PlaybackControl>(*pause).seek);
}

TEST(FoxgloveProtocol, AnythingElseIsRefusedWithAReason) {
  for (const char* text :
       {"", "x", "[]", "{}", R"({"op":5})", R"({"op":"fly"})",
        R"({"op":"subscribe","subscriptions":[{"id":1}]})",
        R"({"op":"subscribe","subscriptions":[{"id":-1,"channelId":0}]})",
        R"({"op":"subscribe","subscriptions":[{"id":0.5,"channelId":0}]})",
        R"({"op":"subscribe","subscriptions":[{"id":4294967296,"channelId":0}]})",
        R"({"op":"unsubscribe","subscriptionIds":["a"]})"}) {
    const auto ask = parse_text(text);
    EXPECT_FALSE(ask) << text;
    if (!ask) {
      EXPECT_LT(to_string(ask.error()).size(), 200U);
    }
  }
  EXPECT_FALSE(parse_text(R"({"op":")" + std::string(10'000, 'x') + "\"}"));
  EXPECT_FALSE(binary({}));
  EXPECT_FALSE(binary({9}));
  EXPECT_FALSE(binary({3, 0}));
  EXPECT_FALSE(binary({3, 2, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0})) << "command";
  EXPECT_FALSE(binary({3, 0, 0, 0, 0xC0, 0x7F, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0})) << "NaN";
  EXPECT_FALSE(binary({3, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0x80, 0, 0, 0, 0})) << "time";
  EXPECT_FALSE(binary({3, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 5, 0, 0, 0, 'x'})) << "length";
}

TEST(FoxgloveProtocol, RandomBytesDoNoHarm) {
  std::mt19937 random{7};
  for (int i = 0; i < 20'000; ++i) {
    std::vector<std::uint8_t> bytes(random() % 40);
    for (auto& byte : bytes) byte = static_cast<std::uint8_t>(random());
    if (!bytes.empty() && i % 2 == 0) bytes[0] = 3;
    static_cast<void>(parse_binary(bytes));
    static_cast<void>(parse_text({reinterpret_cast<const char*>(bytes.data()), bytes.size()}));
  }
}

}  // namespace
}  // namespace pitwall::publishers::foxglove

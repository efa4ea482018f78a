// SPDX-License-Identifier: Apache-2.0
#include "basestation/publishers/ros_view/view.hpp"

#include <gtest/gtest.h>

#include <map>
#include <regex>
#include <set>

#include "basestation/publishers/ros_view/group_message.hpp"
#include "protocol/ros/cdr.hpp"
#include "protocol/ros/names.hpp"
#include "tests/basestation/publishers/ros_view/sample_state.hpp"
#include "tests/protocol/ros/sample_messages.hpp"
#include "tests/support/ros_oracle.hpp"

namespace pitwall::publishers::ros_view {
namespace {

using telemetry::Group;
using testing::kNow;
using testing::kUtc;
using testing::sample_state;
using Reported = std::multimap<std::string, std::vector<std::uint8_t>>;

ViewConfig whole_config() {
  return {.space = "",
          .hardware = "car 7",
          .course = testing::circle(),
          .datum = Geodetic{36.2722, -115.0103, 594.0}};
}

Sink into(Reported& reported, const View& view) {
  return [&reported, &view](const Message& message) {
    reported.emplace(view.topics()[message.topic].name,
                     std::vector<std::uint8_t>{message.cdr.begin(), message.cdr.end()});
  };
}

telemetry::GroupSet all_groups() { return telemetry::groups_of(telemetry::Direction::kDown); }

BaseStatus some_base_status() {
  BaseStatus base_status{.at = kNow};
  base_status.values.fill(0.5);
  return base_status;
}

Reported all_reported(View& view) {
  Reported reported;
  const Sink sink = into(reported, view);
  view.statics(kNow, kUtc, sink);
  view.car(sample_state(), all_groups(), kNow, kUtc, sink);
  view.base(some_base_status(), kUtc, sink);
  return reported;
}

TEST(RosView, EveryTopicHasANameThatRosTakesAndIsTold) {
  View view{whole_config()};
  const Reported reported = all_reported(view);
  std::set<std::string> names;
  for (const Topic& topic : view.topics()) {
    EXPECT_TRUE(ros::dds_topic(topic.name)) << topic.name;
    EXPECT_TRUE(names.insert(topic.name).second) << topic.name;
    EXPECT_TRUE(topic.hash.starts_with("RIHS01_")) << topic.name;
    EXPECT_EQ(reported.count(topic.name), 1U) << topic.name;
  }
  EXPECT_EQ(reported.size(), view.topics().size());
}

TEST(RosView, OnlyWhatIsNewIsTold) {
  View view{whole_config()};
  Reported reported;
  telemetry::GroupSet fresh;
  fresh.add(Group::kEgo);
  view.car(sample_state(), fresh, kNow, kUtc, into(reported, view));
  std::set<std::string> names;
  for (const auto& [name, bytes] : reported) names.insert(name);
  EXPECT_EQ(names, (std::set<std::string>{"/vehicle/odom", "/vehicle/fix", "/tf", "/base/ego"}));
}

TEST(RosView, WithoutATrackThereIsNoRacelineNoOpponentAndNoFusedFix) {
  View view{{}};
  const Reported reported = all_reported(view);
  for (const char* const absent : {"/raceline", "/opponents", "/vehicle/fix", "/tf_static"})
    EXPECT_EQ(reported.count(absent), 0U) << absent;
}

TEST(RosView, EachOfSeveralCarsHasItsSpaceAndItsFrames) {
  ViewConfig config = whole_config();
  config.space = "/car9";
  View view{std::move(config)};
  for (const Topic& topic : view.topics())
    EXPECT_EQ(topic.name.starts_with("/car9/"), !topic.name.starts_with("/tf")) << topic.name;
  const Reported reported = all_reported(view);
  const auto tf = ros::decode<ros::TFMessage>(reported.find("/tf")->second);
  ASSERT_TRUE(tf);
  EXPECT_EQ(tf->transforms.at(0).child_frame_id, "car9/base_link");
  EXPECT_EQ(tf->transforms.at(0).header.frame_id, "map");
}

TEST(RosView, DiagnosticsComeOnceASecondAndAtOnceWhenALevelChanges) {
  View view{whole_config()};
  Reported reported;
  const Sink sink = into(reported, view);
  telemetry::Snapshot state = sample_state();
  view.car(state, all_groups(), kNow, kUtc, sink);
  BaseStatus base_status = some_base_status();
  const auto count = [&](Duration after) {
    base_status.at = kNow + after;
    view.base(base_status, kUtc, sink);
    return reported.count("/diagnostics");
  };
  EXPECT_EQ(count({}), 1U);
  EXPECT_EQ(count(milliseconds(100)), 1U);
  base_status.alarms.push_back({"slip", "slip", "lift", "unack", true});
  EXPECT_EQ(count(milliseconds(200)), 2U);
  EXPECT_EQ(count(milliseconds(300)), 2U);
  EXPECT_EQ(count(milliseconds(1'200)), 3U);
}

TEST(RosView, ALossIsToldForAWhileAndNotForEver) {
  View view{whole_config()};
  BaseStatus base_status = some_base_status();
  base_status.publishers = {{"lcm /car/ego", 5}};
  const auto publishers_at = [&](Duration after) {
    base_status.at = kNow + after;
    auto level = Level::kStale;
    view.base(base_status, kUtc, [&](const Message& message) {
      if (view.topics()[message.topic].name != "/diagnostics") return;
      const auto health = ros::decode<ros::DiagnosticArray>(message.cdr);
      ASSERT_TRUE(health);
      for (const auto& status : health->status)
        if (status.name.ends_with("publishers")) level = static_cast<Level>(status.level);
    });
    return level;
  };
  EXPECT_EQ(publishers_at({}), Level::kWarn);
  EXPECT_EQ(publishers_at(View::kLossShown - seconds(1)), Level::kWarn);
  EXPECT_EQ(publishers_at(View::kLossShown), Level::kOk) << "a level that changed is told at once";
  ++base_status.publishers[0].second;
  EXPECT_EQ(publishers_at(View::kLossShown + seconds(1)), Level::kWarn);
}

// The names that ROS 2 has for what we tell, and what is in it, by Foxglove's readers.
TEST(RosView, FoxglovesReadersDecodeEachStandardMessage) {
  NEEDS_ORACLES();
  View view{whole_config()};
  pitwall::testing::RosOracle oracle;
  const Reported reported = all_reported(view);
  std::set<std::string> types;
  for (const Topic& topic : view.topics()) {
    ros::testing::for_each_message([&]<class M>() {
      if (topic.type != M::kType) return;
      const auto& bytes = reported.find(topic.name)->second;
      const auto message = ros::decode<M>(bytes);
      ASSERT_TRUE(message) << topic.name;
      std::string output;
      ros::testing::append_json(output, *message);
      output = std::regex_replace(output, std::regex{R"(([:,\[])-?nan)"}, "$1\"NaN\"");
      oracle.add(topic.type, topic.schema, bytes, output);
      types.insert(topic.type);
    });
  }
  EXPECT_EQ(types.size(), 7U);
  oracle.expect_agreement();
}

}  // namespace
}  // namespace pitwall::publishers::ros_view

// SPDX-License-Identifier: Apache-2.0
#include "tests/tidy/include_rules.hpp"

#include <gtest/gtest.h>

namespace pitwall::tidy {
namespace {

bool passes(const std::string& path, const std::string& include) {
  return check_include_table(make_source(path, "#include " + include + "\n")).empty();
}

struct IncludeCase {
  std::string path, include;
};

TEST(IncludeTable, WhatTheDesignAllowsPasses) {
  const std::vector<IncludeCase> cases{
      {"protocol/vocabulary/time.hpp", "<compare>"},
      {"protocol/can/decode.cpp", "\"protocol/bits/crc.hpp\""},
      {"protocol/can/manifest.cpp", "\"protocol/yaml/document.hpp\""},
      {"protocol/recording/x.cpp", "\"protocol/recording/y.hpp\""},
      {"protocol/telemetry/export/lua.cpp", "\"protocol/telemetry/registry/registry.hpp\""},
      {"protocol/telemetry/session/association.cpp", "<sodium.h>"},
      {"protocol/transport/udp_socket.cpp", "<sys/socket.h>"},
      {"protocol/transport/can/can_socket.hpp", "\"protocol/can/frame.hpp\""},
      {"vehicle/gateway/inbound.cpp", "\"protocol/can/av21.hpp\""},
      {"vehicle/autonomy/control/lqr.cpp", "<lapacke.h>"},
      {"vehicle/autonomy/localization/ltp.cpp", "<GeographicLib/LocalCartesian.hpp>"},
      {"vehicle/autonomy/planning/plan.cpp", "<Eigen/Dense>"},
      {"vehicle/autonomy/planning/plan.cpp", "\"vehicle/world/trajectory.hpp\""},
      {"vehicle/pipeline/step.cpp", "\"vehicle/autonomy/control/lqr.hpp\""},
      {"vehicle/pipeline/step.cpp", "\"vehicle/safety/supervisor.hpp\""},
      {"vehicle/parameters/reader.cpp", "\"vehicle/safety/gate_params.hpp\""},
      {"vehicle/main.cpp", "\"vehicle/pipeline/step.hpp\""},
      {"vehicle/main.cpp", "<CLI/CLI.hpp>"},
      {"hil/bench/lockstep/lockstep.cpp", "\"vehicle/pipeline/step.hpp\""},
      {"hil/bench/live/live.cpp", "<thread>"},
      {"hil/plant/tyre.cpp", "<Eigen/Dense>"},
      {"hil/nodes/judge.cpp", "\"basestation/state/vehicle_state.hpp\""},
      {"hil/bench/lockstep/virtual_station.cpp", "\"basestation/service/car_service.hpp\""},
      {"hil/main.cpp", "\"basestation/publishers/text/text_view.hpp\""},
      {"tests/hil/x_test.cpp", "\"vehicle/safety/supervisor.hpp\""},
      {"tests/hil/x_test.cpp", "<gtest/gtest.h>"},
  };
  for (const IncludeCase& c : cases) EXPECT_TRUE(passes(c.path, c.include)) << c.path << c.include;
}

TEST(IncludeTable, WhatTheDesignForbidsIsFound) {
  const std::vector<IncludeCase> cases{
      {"protocol/vocabulary/time.hpp", "\"protocol/can/frame.hpp\""},
      {"protocol/can/decode.cpp", "\"protocol/telemetry/registry/registry.hpp\""},
      {"protocol/telemetry/packet.cpp", "<sodium.h>"},
      {"protocol/telemetry/packet.cpp", "<sys/socket.h>"},
      {"protocol/recording/x.cpp", "<fstream>"},
      {"protocol/recording/x.cpp", "\"protocol/ros/cdr.hpp\""},
      {"protocol/transport/clock.cpp", "\"protocol/can/decode.hpp\""},
      {"vehicle/world/ego_state.hpp", "\"vehicle/gateway/inbound.hpp\""},
      {"vehicle/gateway/inbound.cpp", "\"vehicle/autonomy/control/lqr.hpp\""},
      {"vehicle/gateway/inbound.cpp", "\"protocol/transport/clock.hpp\""},
      {"vehicle/autonomy/planning/plan.cpp", "\"vehicle/autonomy/control/lqr.hpp\""},
      {"vehicle/autonomy/planning/plan.cpp", "\"protocol/can/frame.hpp\""},
      {"vehicle/autonomy/planning/plan.cpp", "<chrono>"},
      {"vehicle/autonomy/planning/plan.cpp", "<lapacke.h>"},
      {"vehicle/autonomy/tracking/track.cpp", "<opencv2/core.hpp>"},
      {"vehicle/safety/supervisor.cpp", "\"vehicle/autonomy/planning/plan.hpp\""},
      {"vehicle/pipeline/step.cpp", "\"protocol/transport/clock.hpp\""},
      {"vehicle/pipeline/step.cpp", "\"vehicle/io/radio.hpp\""},
      {"vehicle/pipeline/step.cpp", "\"hil/bench/lockstep/lockstep.hpp\""},
      {"vehicle/parameters/reader.cpp", "\"vehicle/safety/supervisor.hpp\""},
      {"basestation/state/vehicle_state.cpp", "\"basestation/alarms/limits.hpp\""},
      {"basestation/state/vehicle_state.cpp", "\"vehicle/world/mode.hpp\""},
      {"hil/plant/tyre.cpp", "\"vehicle/safety/supervisor.hpp\""},
      {"hil/plant/tyre.cpp", "<thread>"},
      {"basestation/service/car_service.cpp", "\"basestation/publishers/web/frame.hpp\""},
      {"basestation/publishers/lcm/lcm_link.cpp", "\"basestation/publishers/web/frame.hpp\""},
      {"basestation/command/gates.cpp", "\"basestation/link/station.hpp\""},
      {"hil/nodes/judge.cpp", "\"basestation/publishers/web/frame.hpp\""},
      {"vehicle/safety/supervisor.cpp", "<iostream>"},
      {"hil/plant/tyre.cpp", "<unheard/of.h>"},
      {"hil/plant/tyre.cpp", "<hil/plant/car.hpp>"},
      {"hil/plant/tyre.cpp", "\"car.hpp\""},
      {"nowhere/x.cpp", "<vector>"},
  };
  for (const IncludeCase& c : cases) EXPECT_FALSE(passes(c.path, c.include)) << c.path << c.include;
}

bool is_light(const std::string& path, const std::string& include) {
  return check_heavy_headers(make_source(path, "#include " + include + "\n")).empty();
}

TEST(HeavyHeaders, AreIncludedByNoHeaderButTheOnesInTheTable) {
  const std::vector<IncludeCase> cases{
      {"vehicle/autonomy/planning/plan.hpp", "<Eigen/Core>"},
      {"basestation/publishers/web/web_server.hpp", "<boost/asio/post.hpp>"},
      {"vehicle/io/arguments/receiver_options.hpp", "<CLI/CLI.hpp>"},
      {"protocol/dds/domain.hpp", "<fastdds/dds/topic/Topic.hpp>"},
      {"protocol/yaml/strict_map.hpp", "<yaml-cpp/yaml.h>"},
      {"vehicle/autonomy/perception/cloud.hpp", "<pcl/point_cloud.h>"},
      {"vehicle/autonomy/perception/image.hpp", "<opencv2/core.hpp>"},
      // By way of a header that may.
      {"vehicle/autonomy/localization/filter/filter.hpp",
       "\"vehicle/autonomy/localization/filter/ekf_3d_errors.hpp\""},
  };
  for (const IncludeCase& c : cases)
    EXPECT_FALSE(is_light(c.path, c.include)) << c.path << c.include;
}

TEST(HeavyHeaders, AreFreeToACppToATestAndToTheTable) {
  const std::vector<IncludeCase> cases{
      {"vehicle/autonomy/planning/plan.cpp", "<Eigen/Core>"},
      {"tests/vehicle/autonomy/control/carex.hpp", "<Eigen/Core>"},
      {"vehicle/autonomy/localization/filter/rotation.hpp", "<Eigen/Geometry>"},
      {"vehicle/autonomy/localization/filter/ekf_3d_model.hpp",
       "\"vehicle/autonomy/localization/filter/ekf_3d_errors.hpp\""},
      {"vehicle/autonomy/localization/filter/filter.hpp",
       "\"vehicle/autonomy/localization/filter/ekf_3d.hpp\""},
      {"vehicle/autonomy/localization/datum.hpp", "<GeographicLib/LocalCartesian.hpp>"},
  };
  for (const IncludeCase& c : cases)
    EXPECT_TRUE(is_light(c.path, c.include)) << c.path << c.include;
}

TEST(IncludeTable, AnIncludeInACommentIsNone) {
  EXPECT_TRUE(
      includes_of(make_source("a/b.hpp", "// #include <thread>\n/*\n#include <x>\n*/")).empty());
  const auto found = includes_of(make_source("a/b.hpp", "\n#  include <thread>  // why\n"));
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].target, "thread");
  EXPECT_EQ(found[0].line, 2U);
}

TEST(OwnHeader, ComesFirstWhereThereIsOne) {
  const std::string good = "// SPDX\n#include \"a/b.hpp\"\n\n#include <vector>\n";
  const std::string bad = "#include <vector>\n\n#include \"a/b.hpp\"\n";
  EXPECT_TRUE(check_own_header_first(make_source("a/b.cpp", good), true).empty());
  EXPECT_FALSE(check_own_header_first(make_source("a/b.cpp", bad), true).empty());
  EXPECT_FALSE(check_own_header_first(make_source("a/b.cpp", ""), true).empty());
  EXPECT_TRUE(check_own_header_first(make_source("a/b.cpp", bad), false).empty());
  EXPECT_TRUE(check_own_header_first(make_source("a/b.hpp", bad), true).empty());
}

}  // namespace
}  // namespace pitwall::tidy

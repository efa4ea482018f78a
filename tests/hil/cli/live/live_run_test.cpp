// A live run of several cars up to the bus that nobody serves: what it has prepared by then.
// SPDX-License-Identifier: Apache-2.0
#include "hil/cli/live/live_run.hpp"

#include <gtest/gtest.h>

#include "basestation/settings/cars_file.hpp"
#include "protocol/transport/file.hpp"
#include "tests/hil/cli/live/shipped_scenario.hpp"

namespace pitwall::cli {
namespace {

struct LiveRun : testing::Test {
  transport::TemporaryFolder folder = *transport::TemporaryFolder::create("pitwall-live-run-");

  std::string path(const std::string& name) const { return folder.path() + "/" + name; }
};

TEST_F(LiveRun, ASinkWritesItsFileAndIsEmptyWithoutOne) {
  EXPECT_FALSE(*sink_to(""));
  const std::uint8_t bytes[] = {'a', 'b'};
  ASSERT_TRUE((*sink_to(path("log")))(bytes));
  EXPECT_EQ(*transport::read_file(path("log")), "ab");
  EXPECT_FALSE(sink_to(path("none/log")));
}

TEST_F(LiveRun, TheBaseStationReadsTheFileOfItsCars) {
  RunOptions options;
  options.folder = path("out");
  options.interface = "unix:" + path("bus");
  options.log_file = path("events.mcap");
  options.clock = "wall";
  const auto run = run_live(options, shipped("two_stacks"), {});
  ASSERT_FALSE(run) << "on a bus that nobody serves";
  EXPECT_EQ(run.error().place, options.interface);
  EXPECT_TRUE(transport::read_file(path("events.compliant.mcap"))) << "its log is beside ours";

  const std::string file = path("out/cars.yaml");
  const auto text = transport::read_file(file);
  ASSERT_TRUE(text);
  const auto cars = settings::read_cars_text(*text, file, path("out"), {});
  ASSERT_TRUE(cars) << to_string(cars.error());
  ASSERT_EQ(cars->size(), 2u);
  EXPECT_EQ((*cars)[0].car, 1);
  EXPECT_EQ((*cars)[1].car, 2);
  EXPECT_EQ((*cars)[1].car_name, "compliant");
  for (const settings::Arguments& car : *cars) EXPECT_TRUE(transport::read_file(car.keys));
  EXPECT_EQ((*cars)[1].keys, path("out/compliant/keys/base.keys"));
  EXPECT_EQ((*cars)[1].json_path, path("out/compliant/base.json"));
}

}  // namespace
}  // namespace pitwall::cli

// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/live/station_cars.hpp"

#include <gtest/gtest.h>

#include <array>

#include "basestation/settings/cars_file.hpp"

namespace pitwall::bench {
namespace {

TEST(StationCars, TheBaseStationReadsWhatIsWritten) {
  const std::array cars{StationCar{.number = 7,
                                   .name = "a \"b\": #c",
                                   .keys = "7/base keys",
                                   .json = "7/base.json",
                                   .listen = {"127.0.0.1:23431", "127.0.0.1:23432"},
                                   .record = "7/recording",
                                   .judgement = "7/judgement.yaml",
                                   .command_socket = "/tmp/7: commands",
                                   .commands = "7/operator.txt"},
                        StationCar{.number = 8, .keys = "8.keys", .listen = {"127.0.0.1:23433"}}};
  const auto read = settings::read_cars_text(cars_text(cars), "cars.yaml", "folder", {});
  ASSERT_TRUE(read) << to_string(read.error());
  ASSERT_EQ(read->size(), 2u);
  const settings::Arguments &first = (*read)[0], &second = (*read)[1];
  EXPECT_EQ(first.car, 7);
  EXPECT_EQ(first.car_name, "a \"b\": #c");
  EXPECT_EQ(first.keys, "folder/7/base keys");
  EXPECT_EQ(first.json_path, "folder/7/base.json");
  EXPECT_EQ(first.listen, cars[0].listen);
  EXPECT_EQ(first.record_folder, "folder/7/recording");
  EXPECT_EQ(first.judgement_file, "folder/7/judgement.yaml");
  EXPECT_EQ(first.command_socket, "/tmp/7: commands");
  EXPECT_EQ(first.command_file, "folder/7/operator.txt");
  EXPECT_EQ(second.car, 8);
  EXPECT_EQ(second.car_name, "");
  EXPECT_EQ(second.command_socket, "");
}

}  // namespace
}  // namespace pitwall::bench

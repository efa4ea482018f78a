// SPDX-License-Identifier: Apache-2.0
#include "basestation/outlets/wall/recording.hpp"

#include <gtest/gtest.h>

#include "protocol/recorder/segment_folder.hpp"
#include "protocol/transport/file.hpp"
#include "tests/basestation/radio_rig.hpp"
#include "tests/basestation/replay/race.hpp"

namespace pitwall::outlets::wall {
namespace {

struct Base {
  RadioRig rig;
  std::unique_ptr<web::WebServer> web =
      *web::WebServer::start({.ip = transport::kLoopbackIp, .port = 0}, {});
  Wall wall{{}, *rig.station, *web};
};

TEST(Recording, WhatConsolesAreToldIsKept) {
  const auto folder = transport::TemporaryFolder::create("pitwall_wall");
  std::vector<std::string> said;
  std::string recorded;
  {
    Base base;
    auto recorder = start_recording(folder->path(), {}, &base.wall,
                                    [&](const std::string& line) { said.push_back(line); });
    ASSERT_TRUE(recorder);
    base.wall.room().tell_line("mark", R"({"type": "mark", "text": "the mark"})", Instant{});
    base.wall.room().record_with({});
  }
  EXPECT_TRUE(said.empty());  // there was nothing before
  for (const auto paths = recorder::segments_of(folder->path()); const auto& path : *paths) {
    recorded += *transport::read_file(path);
  }
  EXPECT_NE(recorded.find("the mark"), std::string::npos);
}

TEST(Recording, AFolderThatCannotBeIsRefused) {
  EXPECT_FALSE(start_recording("/proc/nothing", {}, nullptr, [](const std::string&) {}));
}

}  // namespace
}  // namespace pitwall::outlets::wall

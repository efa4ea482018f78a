// A base's radio, its web server and its wall.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "basestation/outlets/wall/wall.hpp"
#include "tests/basestation/radio_rig.hpp"

namespace pitwall::outlets::wall {

struct StationWall {
  RadioRig rig;
  std::unique_ptr<web::WebServer> web =
      *web::WebServer::start({.ip = transport::kLoopbackIp, .port = 0}, {});
  Wall wall{{}, *rig.station, *web};
};

}  // namespace pitwall::outlets::wall

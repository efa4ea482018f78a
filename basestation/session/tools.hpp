// Publishers that other tools attach to: LCM, Foxglove, Prometheus; for each car its own.
//   in     a stand that has begun; the board of /metrics, where there is a web server
//   out    publishers of the stand; lines for a person, by `say`
//   invariants
//          of several cars each has its own space, /carN, and the next port. Nothing that a tool
//          says reaches a car: no publisher here has a way to the uplink
//   errors Problem with the option as place
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <memory>

#include "basestation/publishers/foxglove/foxglove_replay.hpp"
#include "basestation/publishers/metrics/board.hpp"
#include "basestation/publishers/ros_view/view.hpp"
#include "basestation/session/car_session.hpp"

namespace pitwall::session {

struct ToolPlace {
  std::size_t car = 0, cars = 1;  // which of how many
  publishers::metrics::Board* board = nullptr;
  const publishers::web::WebServer* server = nullptr;  // of consoles
};

inline constexpr const char* kMetricsPath = "/metrics";

Result<bool, Problem> attach_tools(CarSession& session, const ToolPlace& place, const Say& say);

// Of a replay; none where it is not asked for.
Result<std::unique_ptr<publishers::foxglove::FoxgloveReplay>, Problem> foxglove_of_replay(
    const settings::Arguments& arguments, const replay::Player& player, const Say& say);

// What ROS 2 tools see of a car: its space, its track.
Result<publishers::ros_view::ViewConfig, Problem> view_of(const settings::Arguments& arguments,
                                                          std::size_t cars);
// What the base finds, for whoever publishes it to tools; the service outlives it.
std::function<void(publishers::ros_view::BaseStatus&, Instant)> look_of(
    const service::CarService& car);

}  // namespace pitwall::session

// Publishers for other tools: LCM, Foxglove, ROS 2, Prometheus; each car has its own.
//   in     a session that has begun; the board of /metrics, if there is a web server
//   out    publishers of the session; lines for the log, by `log`
//   invariants
//          with several cars, each has its own namespace, /carN, and the next port. No message of a
//          tool reaches a car: no publisher here has access to the uplink
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
  std::size_t car = 0, cars = 1;  // place of this car, number of cars
  publishers::metrics::Board* board = nullptr;
  const publishers::web::WebServer* server = nullptr;  // of the consoles
};

inline constexpr const char* kMetricsPath = "/metrics";

Result<bool, Problem> attach_tools(CarSession& session, const ToolPlace& place, const LogLine& log);

// For a replay; nullptr if the arguments do not request it.
Result<std::unique_ptr<publishers::foxglove::FoxgloveReplay>, Problem> foxglove_of_replay(
    const settings::Arguments& arguments, const replay::Player& player, const LogLine& log);

// Configuration of the ROS 2 view of a car: its namespace, its track.
Result<publishers::ros_view::ViewConfig, Problem> view_of(const settings::Arguments& arguments,
                                                          std::size_t cars);
// Function that reads values and alarms of the base for publishers; the service outlives it.
std::function<void(publishers::ros_view::BaseStatus&, Instant)> status_reader_of(
    const service::CarService& car);

}  // namespace pitwall::session

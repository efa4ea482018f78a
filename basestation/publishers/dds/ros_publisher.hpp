// ROS 2 publisher over DDS: tools attach to the base as to any node, for example with
// `ros2 topic echo /vehicle/odom`.
//   in     packets as they come; ten times a second the values and alarms of the base, by
//          `read_status`
//   out    the topics of ros_view::View; the node pitwall_base in `ros2 node list`
//   invariants
//          it only writes and subscribes to nothing, so that no ROS node can command a car
//          the loop never waits: a copy of the state goes into a Feed, and a thread encodes and
//          writes. A reader that stops loses its own samples and affects nothing else
//   errors start(): Problem with the option. Later: figures(): drops of the Feed by group, failed
//          writes by topic, endpoints of other nodes with another type, datagrams that are not RTPS
//   source ros2/rmw_fastrtps, ros2/rmw_dds_common
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "basestation/publishers/ros_view/view.hpp"
#include "basestation/service/publisher.hpp"
#include "protocol/dds/domain.hpp"
#include "protocol/vocabulary/result.hpp"

namespace pitwall::publishers::dds {

// ROS 2 distribution; it decides the length of endpoint identities, and so which nodes can read.
enum class Distribution : std::uint8_t { kHumble, kJazzy };

struct RosConfig {
  pitwall::dds::DomainConfig domain{};
  Distribution distribution = Distribution::kJazzy;
  std::string node = "pitwall_base";
  ros_view::ViewConfig view{};
  // Fills in values and alarms, in the loop; empty: the base publishes none.
  std::function<void(ros_view::BaseStatus&, Instant)> read_status{};
};

// "humble" or "jazzy"; for releases in between use jazzy.
Result<Distribution, Problem> distribution_named(const std::string& name);

Result<std::unique_ptr<service::Publisher>, Problem> start(RosConfig config);

}  // namespace pitwall::publishers::dds

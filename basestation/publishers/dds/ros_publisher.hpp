// ROS 2 over DDS: tools attach to the base as to any node, `ros2 topic echo /vehicle/odom`.
//   in     packets as they come; ten times a second what the base finds, by `look`
//   out    the topics of ros_view::View; the node pitwall_base in `ros2 node list`
//   invariants
//          it only writes: no reader of anything, so that nothing from there can command a car
//          the loop never waits: a copy of the state goes into a Feed, a thread encodes and writes.
//          A reader that stops costs its own samples and nothing else
//   errors start(): Problem with the option. Later: figures(): what the Feed dropped by group, what
//          DDS did not take by topic, endpoints of others with another type, datagrams that are no
//          RTPS
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

// How long the identities of endpoints are, and so who can read them.
enum class Distribution : std::uint8_t { kHumble, kJazzy };

struct RosConfig {
  pitwall::dds::DomainConfig domain{};
  Distribution distribution = Distribution::kJazzy;
  std::string node = "pitwall_base";
  ros_view::ViewConfig view{};
  // Fills in values and alarms, in the loop; none: the base judges nothing.
  std::function<void(ros_view::BaseStatus&, Instant)> look{};
};

// "humble" or "jazzy"; those between are as jazzy.
Result<Distribution, Problem> distribution_named(const std::string& name);

Result<std::unique_ptr<service::Publisher>, Problem> start(RosConfig config);

}  // namespace pitwall::publishers::dds

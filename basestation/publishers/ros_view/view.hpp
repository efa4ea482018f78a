// ROS 2 view of a car: topics, and the messages made from a state. All publishers of ROS 2 messages
// use it.
//   in     states as they come, values and alarms of the base ten times a second, time
//   out    topics with types, texts and hashes; messages as CDR, each with the time of its sample
//   invariants
//          a message is made only from a group that is new, so that nothing is repeated. For absent
//          values see car_messages.hpp, group_message.hpp
//          diagnostics once a second, at once when a level changes; a loss of a publisher is shown
//          for kLossShown after its count has grown
//   cost   a state with all its groups: some tens of microseconds
//
//   /vehicle/odom /vehicle/fix /imu /gnss/{top,bottom}/fix /diagnostics /opponents /raceline
//   /base/GROUP for each group of pitwall_msgs, all with the car's namespace in front; all cars
//   share /tf and /tf_static, where their frames have a prefix instead
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "basestation/publishers/ros_view/car_messages.hpp"
#include "basestation/publishers/ros_view/diagnostics.hpp"
#include "basestation/state/course.hpp"
#include "protocol/telemetry/registry/registry.hpp"

namespace pitwall::publishers::ros_view {

struct Topic {
  std::string name;      // "/vehicle/odom"
  std::string type;      // "nav_msgs/msg/Odometry"
  std::string schema;    // as `ros2msg`
  std::string hash;      // "RIHS01_..."
  bool latched = false;  // later subscribers get the newest message
};

struct Message {
  std::size_t topic = 0;
  Instant at{};  // of the sample, on the base's clock
  std::span<const std::uint8_t> cdr;
};
using Sink = std::function<void(const Message&)>;

struct ViewConfig {
  std::string space{};     // namespace "/car7"; may be empty
  std::string hardware{};  // of diagnostics
  std::optional<state::Course> course{};
  std::optional<Geodetic> datum{};
};

class View {
 public:
  static constexpr Duration kLossShown = seconds(10);

  explicit View(ViewConfig config);

  const std::vector<Topic>& topics() const { return topics_; }

  // Static messages, which never change; call it once, at the start.
  void statics(Instant now, Duration utc_minus_base, const Sink& sink);
  void car(const telemetry::Snapshot& state, telemetry::GroupSet fresh, Instant now,
           Duration utc_minus_base, const Sink& sink);
  void base(const BaseStatus& base_status, Duration utc_minus_base, const Sink& sink);

 private:
  enum Fixed : std::size_t {
    kOdom,
    kFix,
    kImu,
    kTop,
    kBottom,
    kDiagnostics,
    kOpponentsTopic,
    kRaceline,
    kTf,
    kTfStatic,
    kFixed
  };

  template <ros::Message M>
  void add(std::size_t place, const std::string& name, bool latched);
  template <class M>
  void put(std::size_t topic, Instant at, const M& message, const Sink& sink);
  template <class M>
  void put_if(std::size_t topic, Instant at, const std::optional<M>& message, const Sink& sink);
  void put_group(std::size_t place, Instant at, Duration utc_minus_base,
                 std::span<const double> values, const Sink& sink);
  void publish_health(const BaseStatus& base_status, Duration utc_minus_base, const Sink& sink);
  bool loses(const BaseStatus& base_status);

  ViewConfig config_;
  Frames frames_;
  std::optional<Ground> ground_;
  std::vector<Topic> topics_;
  telemetry::Snapshot newest_;
  std::vector<std::uint8_t> bytes_;  // of the present message
  std::vector<Level> levels_;        // of the newest diagnostics message
  Instant health_reported_{};
  std::uint64_t lost_ = 0;  // by all publishers
  std::optional<Instant> lost_at_{};
};

}  // namespace pitwall::publishers::ros_view

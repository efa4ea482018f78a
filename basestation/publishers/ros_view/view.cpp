// SPDX-License-Identifier: Apache-2.0
#include "basestation/publishers/ros_view/view.hpp"

#include <algorithm>
#include <cmath>

#include "basestation/publishers/ros_view/group_message.hpp"
#include "basestation/publishers/ros_view/opponent_markers.hpp"
#include "protocol/ros/cdr.hpp"

namespace pitwall::publishers::ros_view {
namespace {

using telemetry::Group;

constexpr Duration kHealthEvery = seconds(1);

std::string prefix_of(const std::string& space) {
  return space.empty() ? space : space.substr(1) + "/";
}

}  // namespace

template <ros::Message M>
void View::add(std::size_t place, const std::string& name, bool latched) {
  const ros::TypeDescription type = ros::describe<M>();
  topics_[place] = {name, std::string{M::kType}, ros::message_text(type), ros::type_hash(type),
                    latched};
}

View::View(ViewConfig config)
    : config_(std::move(config)),
      frames_{.map = "map", .base = prefix_of(config_.space) + "base_link"},
      topics_(kFixed) {
  if (config_.datum) ground_.emplace(*config_.datum);
  const std::string& space = config_.space;
  add<ros::Odometry>(kOdom, space + "/vehicle/odom", false);
  add<ros::NavSatFix>(kFix, space + "/vehicle/fix", false);
  add<ros::Imu>(kImu, space + "/imu", false);
  add<ros::NavSatFix>(kTop, space + "/gnss/top/fix", false);
  add<ros::NavSatFix>(kBottom, space + "/gnss/bottom/fix", false);
  add<ros::DiagnosticArray>(kDiagnostics, space + "/diagnostics", false);
  add<ros::MarkerArray>(kOpponentsTopic, space + "/opponents", false);
  add<ros::Path>(kRaceline, space + "/raceline", true);
  add<ros::TFMessage>(kTf, "/tf", false);
  add<ros::TFMessage>(kTfStatic, "/tf_static", true);
  for (const GroupMessage& message : group_messages())
    topics_.push_back({space + "/base/" + message.group, message.type.type.name,
                       ros::message_text(message.type), ros::type_hash(message.type), false});
}

template <class M>
void View::put(std::size_t topic, Instant at, const M& message, const Sink& sink) {
  bytes_.clear();
  ros::encode(message, bytes_);
  sink({topic, at, bytes_});
}

template <class M>
void View::put_if(std::size_t topic, Instant at, const std::optional<M>& message,
                  const Sink& sink) {
  if (message) put(topic, at, *message, sink);
}

void View::put_group(std::size_t place, Instant at, Duration utc_minus_base,
                     std::span<const double> values, const Sink& sink) {
  bytes_.clear();
  encode_group(CarMessages{frames_, utc_minus_base}.header(at, frames_.base), values, bytes_);
  sink({kFixed + place, at, bytes_});
}

void View::statics(Instant now, Duration utc_minus_base, const Sink& sink) {
  const CarMessages messages{frames_, utc_minus_base};
  if (config_.course)
    put(kRaceline, now, raceline(*config_.course, messages.header(now, frames_.map)), sink);
  if (!ground_) return;
  ros::TransformStamped earth{.header = messages.header(now, "earth"),
                              .child_frame_id = frames_.map,
                              .transform = ground_->earth_to_map()};
  put(kTfStatic, now, ros::TFMessage{{std::move(earth)}}, sink);
}

void View::car(const telemetry::Snapshot& state, telemetry::GroupSet fresh, Instant now,
               Duration utc_minus_base, const Sink& sink) {
  newest_ = state;
  const CarMessages messages{frames_, utc_minus_base};
  if (fresh.has(Group::kEgo)) {
    const Instant at = state.at(Group::kEgo);
    put_if(kOdom, at, messages.odometry(state), sink);
    put_if(kTf, at, messages.transform(state), sink);
    if (ground_) put_if(kFix, at, messages.fix(state, *ground_), sink);
  }
  if (fresh.has(Group::kDynamics))
    put_if(kImu, state.at(Group::kDynamics), messages.imu(state), sink);
  if (fresh.has(Group::kGnss0))
    put(kTop, state.at(Group::kGnss0), messages.receiver_fix(state, 0), sink);
  if (fresh.has(Group::kGnss1))
    put(kBottom, state.at(Group::kGnss1), messages.receiver_fix(state, 1), sink);
  bool opponents = false;
  for (std::size_t i = 0; i < kOpponents; ++i)
    opponents |= fresh.has(static_cast<Group>(telemetry::index_of(Group::kOpponent1) + i));
  if (opponents && config_.course)
    put(kOpponentsTopic, now, opponent_markers(messages, state, *config_.course, now), sink);
  const auto& groups = group_messages();
  for (const telemetry::GroupRow& row : telemetry::kGroupTable) {
    if (!fresh.has(row.group) || row.direction != telemetry::Direction::kDown) continue;
    const std::size_t place = message_index(row.group);
    put_group(
        place, state.at(row.group), utc_minus_base,
        std::span{state.values.at}.subspan(groups[place].rows.front(), groups[place].rows.size()),
        sink);
  }
}

void View::base(const BaseStatus& base_status, Duration utc_minus_base, const Sink& sink) {
  const auto& groups = group_messages();
  std::vector<double> values;
  for (std::size_t place = 0; place < groups.size(); ++place) {
    if (!groups[place].of_base) continue;
    values.clear();
    for (const std::size_t row : groups[place].rows) values.push_back(base_status.values[row]);
    const bool known = std::ranges::any_of(values, [](double v) { return !std::isnan(v); });
    if (known) put_group(place, base_status.at, utc_minus_base, values, sink);
  }
  publish_health(base_status, utc_minus_base, sink);
}

bool View::loses(const BaseStatus& base_status) {
  std::uint64_t lost = 0;
  for (const auto& [name, count] : base_status.publishers) lost += count;
  if (lost > lost_) lost_at_ = base_status.at;
  lost_ = lost;
  return lost_at_ && base_status.at - *lost_at_ < kLossShown;
}

void View::publish_health(const BaseStatus& base_status, Duration utc_minus_base,
                          const Sink& sink) {
  ros::DiagnosticArray health{
      .header = CarMessages{frames_, utc_minus_base}.header(base_status.at, ""),
      .status = diagnostics(newest_, base_status, config_.hardware, loses(base_status))};
  std::vector<Level> levels;
  for (const ros::DiagnosticStatus& status : health.status)
    levels.push_back(static_cast<Level>(status.level));
  if (levels == levels_ && base_status.at - health_reported_ < kHealthEvery) return;
  levels_ = std::move(levels);
  health_reported_ = base_status.at;
  put(kDiagnostics, base_status.at, health, sink);
}

}  // namespace pitwall::publishers::ros_view

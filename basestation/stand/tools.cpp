// SPDX-License-Identifier: Apache-2.0
#include "basestation/stand/tools.hpp"

#include <cmath>
#include <string>
#include <utility>

#include "basestation/outlets/dds/ros_outlet.hpp"
#include "basestation/outlets/foxglove/foxglove_outlet.hpp"
#include "basestation/outlets/lcm/lcm_outlet.hpp"
#include "basestation/outlets/metrics/metrics_outlet.hpp"
#include "basestation/outlets/wall/data_files.hpp"
#include "basestation/outlets/wall/track_document.hpp"
#include "protocol/recorder/recorder.hpp"

namespace pitwall::stand {
namespace {

namespace foxglove = outlets::foxglove;
namespace lcm = outlets::lcm;
namespace metrics = outlets::metrics;
namespace ros_view = outlets::ros_view;
using settings::Arguments;

constexpr int kPortMax = 65'535;

std::string space_of(const Arguments& a, std::size_t cars) {
  return cars > 1 ? "/car" + std::to_string(a.car) : std::string{};
}

// Tools get the texts that consoles get.
template <class ToolOutlet>
void tell_texts(outlets::wall::Wall* wall, ToolOutlet& outlet) {
  if (wall == nullptr) return;
  wall->room().record_with([&outlet](std::string_view type, std::string_view text, Instant at) {
    if (const auto topic = recorder::topic_named(type)) outlet.text(*topic, at, text);
  });
}

Result<std::unique_ptr<lcm::LcmOutlet>, Problem> lcm_of(const Arguments& a, std::size_t cars) {
  const auto url = lcm::LcmUrl::parse(a.lcm_url->empty() ? lcm::kDefaultUrl : *a.lcm_url);
  if (!url) return Unexpected{url.error()};
  if (url->leaves_the_machine() && !a.network) {
    return Unexpected{
        Problem{"--lcm " + url->text(), "reaches other machines; add --network if that is meant"}};
  }
  return lcm::LcmOutlet::start(*url, recorder::clock_now(), space_of(a, cars));
}

Result<std::unique_ptr<outlets::Outlet>, Problem> ros_of(const Arguments& a, std::size_t cars,
                                                         const outlets::wall::Wall* wall) {
  if (!a.ros_interface.starts_with("127.") && !a.network) {
    return Unexpected{Problem{"--ros-interface " + a.ros_interface,
                              "reaches other machines; add --network if that is meant"}};
  }
  const auto distribution = outlets::dds::distribution_named(a.ros_distribution);
  if (!distribution) return Unexpected{distribution.error()};
  auto view = view_of(a, cars);
  if (!view) return Unexpected{view.error()};
  outlets::dds::RosConfig config{
      .domain = {.domain = a.ros_domain, .interface = a.ros_interface, .peers = a.ros_peers},
      .distribution = *distribution,
      .view = *std::move(view)};
  if (cars > 1) config.node += "_car" + std::to_string(a.car);
  if (wall != nullptr) config.look = look_of(*wall);
  return outlets::dds::start(std::move(config));
}

foxglove::DeskConfig desk_of(const Arguments& a, std::size_t car, ros_view::ViewConfig view) {
  const int port = *a.foxglove_port == 0 ? 0 : *a.foxglove_port + static_cast<int>(car);
  foxglove::DeskConfig config;
  config.listen = {.ip = a.network ? transport::kAnyIp : transport::kLoopbackIp,
                   .port = static_cast<std::uint16_t>(port <= kPortMax ? port : 0)};
  config.access.names = a.web_names;
  config.access.origins = a.foxglove_origins;
  config.name =
      "Pitwall car " + std::to_string(a.car) + (a.car_name.empty() ? "" : " ") + a.car_name;
  config.view = std::move(view);
  config.clock = recorder::clock_now();
  return config;
}

void say_where(const transport::UdpAddress& address, const std::string& whose, const Say& say) {
  say(whose + "Foxglove at ws://" + to_string(address));
}

}  // namespace

Result<ros_view::ViewConfig, Problem> view_of(const Arguments& a, std::size_t cars) {
  ros_view::ViewConfig view{.space = space_of(a, cars), .hardware = a.car_name};
  if (a.track.empty()) return view;
  auto track = outlets::wall::read_track(outlets::wall::track_file(a.track));
  if (!track) return Unexpected{track.error()};
  view.course = std::move(track->course);
  if (!std::isnan(track->datum.latitude_deg)) {
    view.datum = ros_view::Geodetic{.latitude_deg = track->datum.latitude_deg,
                                    .longitude_deg = track->datum.longitude_deg,
                                    .height_m = track->datum.height_m};
  }
  return view;
}

std::function<void(ros_view::BaseSight&, Instant)> look_of(const outlets::wall::Wall& wall) {
  return [&wall](ros_view::BaseSight& sight, Instant now) {
    for (const picture::BaseRow& row : picture::kBaseTable) {
      const picture::FieldView view = wall.seen(picture::id_of(row.field), now);
      if (picture::usable(view)) sight.values[picture::index_of(row.field)] = view.value;
    }
    for (const alarms::ListedAlarm& alarm : wall.watch().alarms().active()) {
      sight.alarms.push_back({.key = std::string{alarm.key},
                              .text = std::string{alarm.text},
                              .response = std::string{alarm.response},
                              .state = std::string{alarms::text_of(alarm.state)},
                              .high = alarm.priority == alarms::Priority::kHigh});
    }
  };
}

Result<bool, Problem> attach_tools(CarStand& stand, const ToolPlace& place, const Say& say) {
  const Arguments& a = stand.arguments();
  std::vector<const outlets::Outlet*> told;
  const auto attach = [&](auto outlet) {
    tell_texts(stand.wall(), *outlet);
    told.push_back(outlet.get());
    stand.attach(std::move(outlet));
  };
  if (a.lcm_url) {
    auto started = lcm_of(a, place.cars);
    if (!started) return Unexpected{started.error()};
    attach(*std::move(started));
  }
  if (a.foxglove_port) {
    auto view = view_of(a, place.cars);
    if (!view) return Unexpected{view.error()};
    foxglove::FoxgloveOutlet::Look look;
    if (stand.wall() != nullptr) look = look_of(*stand.wall());
    auto started =
        foxglove::FoxgloveOutlet::start(desk_of(a, place.car, *std::move(view)), std::move(look));
    if (!started) return Unexpected{started.error()};
    say_where((*started)->local(),
              place.cars > 1 ? "car " + std::to_string(a.car) + ": " : std::string{}, say);
    attach(*std::move(started));
  }
  if (a.ros) {
    auto started = ros_of(a, place.cars, stand.wall());
    if (!started) return Unexpected{started.error()};
    told.push_back(started->get());
    stand.attach(*std::move(started));
  }
  if (place.board == nullptr) return true;
  stand.attach(std::make_unique<metrics::MetricsOutlet>(
      *place.board, metrics::Stand{.place = place.car,
                                   .car = a.car,
                                   .name = a.car_name,
                                   .wall = stand.wall(),
                                   .server = place.server,
                                   .outlets = std::move(told)}));
  return true;
}

Result<std::unique_ptr<foxglove::FoxgloveReplay>, Problem> foxglove_of_replay(
    const Arguments& a, const replay::Player& player, const Say& say) {
  if (!a.foxglove_port) return std::unique_ptr<foxglove::FoxgloveReplay>{};
  auto view = view_of(a, 1);
  if (!view) return Unexpected{view.error()};
  auto started = foxglove::FoxgloveReplay::start(desk_of(a, 0, *std::move(view)), player);
  if (started) say_where((*started)->local(), "", say);
  return started;
}

}  // namespace pitwall::stand

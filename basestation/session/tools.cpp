// SPDX-License-Identifier: Apache-2.0
#include "basestation/session/tools.hpp"

#include <cmath>
#include <string>
#include <utility>

#include "basestation/publishers/console/track_document.hpp"
#include "basestation/publishers/dds/ros_publisher.hpp"
#include "basestation/publishers/foxglove/foxglove_publisher.hpp"
#include "basestation/publishers/lcm/lcm_publisher.hpp"
#include "basestation/publishers/metrics/metrics_publisher.hpp"
#include "basestation/settings/data_files.hpp"
#include "protocol/recorder/recorder.hpp"

namespace pitwall::session {
namespace {

namespace foxglove = publishers::foxglove;
namespace lcm = publishers::lcm;
namespace metrics = publishers::metrics;
namespace ros_view = publishers::ros_view;
using settings::Arguments;

constexpr int kPortMax = 65'535;

std::string space_of(const Arguments& a, std::size_t cars) {
  return cars > 1 ? "/car" + std::to_string(a.car) : std::string{};
}

// Tools get the messages that consoles get.
template <class ToolPublisher>
void subscribe(service::CarService& car, ToolPublisher& publisher) {
  car.messages().subscribe([&publisher](std::string_view type, std::string_view text, Instant at) {
    if (const auto topic = recorder::topic_named(type)) publisher.text(*topic, at, text);
  });
}

Result<std::unique_ptr<lcm::LcmPublisher>, Problem> lcm_of(const Arguments& a, std::size_t cars) {
  const auto url = lcm::LcmUrl::parse(a.lcm_url->empty() ? lcm::kDefaultUrl : *a.lcm_url);
  if (!url) return Unexpected{url.error()};
  if (url->leaves_the_machine() && !a.network) {
    return Unexpected{
        Problem{"--lcm " + url->text(), "reaches other machines; add --network if that is meant"}};
  }
  return lcm::LcmPublisher::start(*url, recorder::clock_now(), space_of(a, cars));
}

Result<std::unique_ptr<service::Publisher>, Problem> ros_of(const Arguments& a, std::size_t cars,
                                                            const service::CarService& car) {
  if (!a.ros_interface.starts_with("127.") && !a.network) {
    return Unexpected{Problem{"--ros-interface " + a.ros_interface,
                              "reaches other machines; add --network if that is meant"}};
  }
  const auto distribution = publishers::dds::distribution_named(a.ros_distribution);
  if (!distribution) return Unexpected{distribution.error()};
  auto view = view_of(a, cars);
  if (!view) return Unexpected{view.error()};
  publishers::dds::RosConfig config{
      .domain = {.domain = a.ros_domain, .interface = a.ros_interface, .peers = a.ros_peers},
      .distribution = *distribution,
      .view = *std::move(view)};
  if (cars > 1) config.node += "_car" + std::to_string(a.car);
  config.read_status = status_reader_of(car);
  return publishers::dds::start(std::move(config));
}

Result<foxglove::ServerConfig, Problem> foxglove_of(const Arguments& a, std::size_t car,
                                                    ros_view::ViewConfig view) {
  const int port = *a.foxglove_port == 0 ? 0 : *a.foxglove_port + static_cast<int>(car);
  foxglove::ServerConfig config;
  const auto address = transport::parse_udp_address(a.foxglove_address + ":" +
                                                    std::to_string(port <= kPortMax ? port : 0));
  if (!address) return Unexpected{address.error()};
  config.listen = *address;
  if (!a.foxglove_address.starts_with("127.") && a.foxglove_tokens.empty()) {
    return Unexpected{Problem{"--foxglove-address " + a.foxglove_address,
                              "reaches other machines; --foxglove-tokens FILE says who may read"}};
  }
  if (!a.foxglove_tokens.empty()) config.access.default_role.reset();
  const auto tokens = use_tokens(a.foxglove_tokens, config.access);
  if (!tokens) return Unexpected{tokens.error()};
  auto tls = tls_of(a, [](const std::string&) {});  // the console's service has said it
  if (!tls) return Unexpected{tls.error()};
  config.tls = *std::move(tls);
  config.access.encrypted = config.tls != nullptr;
  config.access.names = a.web_names;
  config.access.origins = a.foxglove_origins;
  config.name =
      "Pitwall car " + std::to_string(a.car) + (a.car_name.empty() ? "" : " ") + a.car_name;
  config.view = std::move(view);
  config.clock = recorder::clock_now();
  return config;
}

void log_address(const Arguments& a, const UdpAddress& address, const std::string& whose,
                 const LogLine& log) {
  log(whose + "Foxglove at " + (a.web_certificate.empty() ? "ws://" : "wss://") +
      to_string(address));
}

}  // namespace

Result<ros_view::ViewConfig, Problem> view_of(const Arguments& a, std::size_t cars) {
  ros_view::ViewConfig view{.space = space_of(a, cars), .hardware = a.car_name};
  if (a.track.empty()) return view;
  auto track = publishers::console::read_track(settings::track_file(a.track));
  if (!track) return Unexpected{track.error()};
  view.course = std::move(track->course);
  if (!std::isnan(track->datum.latitude_deg)) {
    view.datum = ros_view::Geodetic{.latitude_deg = track->datum.latitude_deg,
                                    .longitude_deg = track->datum.longitude_deg,
                                    .height_m = track->datum.height_m};
  }
  return view;
}

std::function<void(ros_view::BaseStatus&, Instant)> status_reader_of(
    const service::CarService& car) {
  return [&car](ros_view::BaseStatus& base_status, Instant now) {
    for (const state::BaseRow& row : state::kBaseTable) {
      const state::FieldView view = car.view(state::id_of(row.field), now);
      if (state::usable(view)) base_status.values[state::index_of(row.field)] = view.value;
    }
    for (const alarms::ListedAlarm& alarm : car.evaluator().alarms().active()) {
      base_status.alarms.push_back({.key = std::string{alarm.key},
                                    .text = std::string{alarm.text},
                                    .response = std::string{alarm.response},
                                    .state = std::string{alarms::text_of(alarm.state)},
                                    .high = alarm.priority == alarms::Priority::kHigh});
    }
  };
}

Result<bool, Problem> attach_tools(CarSession& session, const ToolPlace& place,
                                   const LogLine& log) {
  const Arguments& a = session.arguments();
  service::CarService& car = session.service();
  std::vector<const service::Publisher*> attached;
  const auto attach = [&](auto publisher) {
    subscribe(car, *publisher);
    attached.push_back(publisher.get());
    session.attach(std::move(publisher));
  };
  if (a.lcm_url) {
    auto started = lcm_of(a, place.cars);
    if (!started) return Unexpected{started.error()};
    attach(*std::move(started));
  }
  if (a.foxglove_port) {
    auto view = view_of(a, place.cars);
    if (!view) return Unexpected{view.error()};
    auto config = foxglove_of(a, place.car, *std::move(view));
    if (!config) return Unexpected{config.error()};
    auto started = foxglove::FoxglovePublisher::start(*std::move(config), status_reader_of(car));
    if (!started) return Unexpected{started.error()};
    log_address(a, (*started)->local(),
                place.cars > 1 ? "car " + std::to_string(a.car) + ": " : std::string{}, log);
    attach(*std::move(started));
  }
  if (a.ros) {
    auto started = ros_of(a, place.cars, car);
    if (!started) return Unexpected{started.error()};
    attached.push_back(started->get());
    session.attach(*std::move(started));
  }
  if (place.board == nullptr) return true;
  session.attach(std::make_unique<metrics::MetricsPublisher>(
      *place.board,
      metrics::MetricsSources{
          .place = place.car, .server = place.server, .publishers = std::move(attached)}));
  return true;
}

Result<std::unique_ptr<foxglove::FoxgloveReplay>, Problem> foxglove_of_replay(
    const Arguments& a, const replay::Player& player, const LogLine& log) {
  if (!a.foxglove_port) return std::unique_ptr<foxglove::FoxgloveReplay>{};
  auto view = view_of(a, 1);
  if (!view) return Unexpected{view.error()};
  auto config = foxglove_of(a, 0, *std::move(view));
  if (!config) return Unexpected{config.error()};
  auto started = foxglove::FoxgloveReplay::start(*std::move(config), player);
  if (started) log_address(a, (*started)->local(), "", log);
  return started;
}

}  // namespace pitwall::session

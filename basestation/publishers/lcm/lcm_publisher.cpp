// SPDX-License-Identifier: Apache-2.0
#include "basestation/publishers/lcm/lcm_publisher.hpp"

#include <utility>

#include "protocol/transport/readiness.hpp"
#include "protocol/transport/realtime.hpp"

namespace pitwall::publishers::lcm {
namespace {}  // namespace

Result<std::unique_ptr<LcmPublisher>, Problem> LcmPublisher::start(const LcmUrl& url,
                                                                   const recorder::ClockMap& clock,
                                                                   std::string prefix) {
  auto link = LcmLink::open(url);
  if (!link) return Unexpected{link.error()};
  const auto shared = std::make_shared<LcmLink>(*std::move(link));
  return std::make_unique<LcmPublisher>(
      [shared](const std::string& channel, std::span<const std::uint8_t> message) {
        return shared->publish(channel, message);
      },
      clock, std::move(prefix));
}

LcmPublisher::LcmPublisher(Publish publish, const recorder::ClockMap& clock, std::string prefix)
    : publish_(std::move(publish)), encoder_(clock) {
  for (std::size_t i = 0; i < feed::kStatusChannel; ++i) {
    names_.push_back(prefix + encoder_.topic(static_cast<std::uint16_t>(i)));
  }
  thread_ = std::thread{[this] { run(); }};
}

LcmPublisher::~LcmPublisher() {
  feed_.close();
  thread_.join();
}

void LcmPublisher::packet(const service::CarService& car, const telemetry::Arrival& arrival) {
  feed_.sample(car.link().endpoint().state(), arrival.groups, arrival.received);
}

void LcmPublisher::run() {
  transport::lower_priority();
  const int fd = feed_.fd();
  for (bool more = true; more;) {
    transport::wait_readable({&fd, 1}, Instant::max());
    more = !feed_.closed();
    for (const feed::Item& item : feed_.take()) {
      if (const auto* const sample = std::get_if<std::unique_ptr<const feed::Sample>>(&item)) {
        publish(**sample);
      } else if (const auto* const reported = std::get_if<feed::Reported>(&item)) {
        publish(*reported);
      }
    }
  }
}

void LcmPublisher::publish(const feed::Sample& sample) {
  for (const telemetry::GroupRow& row : telemetry::kGroupTable) {
    if (!sample.groups.has(row.group) || !sample.state.ever(row.group)) continue;
    const recorder::GroupBytes bytes = recorder::encode(row.group, sample.state.values);
    send({.channel = recorder::channel_of(row.group),
          .logged = sample.received,
          .published = sample.state.at(row.group),
          .data = bytes.span()});
  }
}

void LcmPublisher::publish(const feed::Reported& reported) {
  const auto* const bytes = reinterpret_cast<const std::uint8_t*>(reported.json.data());
  send({.channel = recorder::channel_of(reported.topic),
        .logged = reported.at,
        .published = reported.at,
        .data = {bytes, reported.json.size()}});
}

void LcmPublisher::send(const recorder::Record& record) {
  encoder_.encode(record, message_);
  ++(publish_(names_[record.channel], message_) ? sent_ : failed_);
}

std::optional<service::PublisherFigures> LcmPublisher::figures() const {
  service::PublisherFigures figures{.publisher = "lcm", .sent = sent_, .failed = failed_};
  const feed::ChannelCounts drops = feed_.drops();
  for (std::size_t i = 0; i < names_.size(); ++i) {
    if (drops[i] != 0) figures.dropped.emplace_back(names_[i], drops[i]);
  }
  return figures;
}

}  // namespace pitwall::publishers::lcm

// SPDX-License-Identifier: Apache-2.0
#include "basestation/publishers/foxglove/foxglove_publisher.hpp"

#include <array>
#include <utility>

#include "protocol/transport/clock.hpp"
#include "protocol/transport/readiness.hpp"
#include "protocol/transport/realtime.hpp"

namespace pitwall::publishers::foxglove {

Result<std::unique_ptr<FoxglovePublisher>, Problem> FoxglovePublisher::start(ServerConfig config,
                                                                             Look look) {
  auto desk = FoxgloveServer::start(std::move(config));
  if (!desk) return Unexpected{desk.error()};
  return std::unique_ptr<FoxglovePublisher>{
      new FoxglovePublisher{*std::move(desk), std::move(look)}};
}

FoxglovePublisher::FoxglovePublisher(std::unique_ptr<FoxgloveServer> desk, Look look)
    : desk_(std::move(desk)),
      look_(std::move(look)),
      figures_(desk_->figures()),
      thread_([this] { run(); }) {}

FoxglovePublisher::~FoxglovePublisher() {
  feed_.close();
  thread_.join();
}

void FoxglovePublisher::packet(const service::CarService& car, const telemetry::Arrival& arrival) {
  feed_.sample(car.link().endpoint().state(), arrival.groups, arrival.received);
}

void FoxglovePublisher::publish(const service::CarService&, Instant now) {
  if (now < due()) return;
  looked_ = now;
  auto sight = std::make_unique<feed::Sight>();
  sight->at = now;
  look_(*sight, now);
  feed_.sight(std::move(sight));
}

void FoxglovePublisher::run() {
  transport::give_way();
  const std::array<int, 2> watched{feed_.fd(), desk_->fd()};
  while (!feed_.closed()) {
    transport::wait_readable(watched, desk_->due());
    desk_->hear();
    for (const feed::Item& item : feed_.take()) desk_->take(item);
    const Instant now = transport::monotonic_now();
    desk_->turn(now, now);
    const std::lock_guard hold(lock_);
    figures_ = desk_->figures();
  }
}

std::optional<service::PublisherFigures> FoxglovePublisher::figures() const {
  service::PublisherFigures figures;
  {
    const std::lock_guard hold(lock_);
    figures = figures_;
  }
  // What this thread did not keep up with, whoever was there.
  const feed::ChannelCounts drops = feed_.drops();
  for (std::size_t i = 0; i < drops.size(); ++i) {
    if (drops[i] != 0) figures.dropped.emplace_back("feed:" + names_[i], drops[i]);
  }
  return figures;
}

}  // namespace pitwall::publishers::foxglove

// SPDX-License-Identifier: Apache-2.0
#include "basestation/publishers/foxglove/foxglove_publisher.hpp"

#include <array>
#include <utility>

#include "protocol/transport/clock.hpp"
#include "protocol/transport/readiness.hpp"
#include "protocol/transport/realtime.hpp"

namespace pitwall::publishers::foxglove {

Result<std::unique_ptr<FoxglovePublisher>, Problem> FoxglovePublisher::start(
    ServerConfig config, ReadStatus read_status) {
  auto server = FoxgloveServer::start(std::move(config));
  if (!server) return Unexpected{server.error()};
  return std::unique_ptr<FoxglovePublisher>{
      new FoxglovePublisher{*std::move(server), std::move(read_status)}};
}

FoxglovePublisher::FoxglovePublisher(std::unique_ptr<FoxgloveServer> server, ReadStatus read_status)
    : server_(std::move(server)),
      read_status_(std::move(read_status)),
      figures_(server_->figures()),
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
  polled_at_ = now;
  auto base_status = std::make_unique<feed::BaseStatus>();
  base_status->at = now;
  read_status_(*base_status, now);
  feed_.base_status(std::move(base_status));
}

void FoxglovePublisher::run() {
  transport::lower_priority();
  const std::array<int, 2> watched{feed_.fd(), server_->fd()};
  while (!feed_.closed()) {
    transport::wait_readable(watched, server_->due());
    server_->receive();
    for (const feed::Item& item : feed_.take()) server_->take(item);
    const Instant now = transport::monotonic_now();
    server_->turn(now, now);
    const std::lock_guard hold(lock_);
    figures_ = server_->figures();
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

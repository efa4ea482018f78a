// Foxglove publisher of a live car: a FoxgloveServer on its own thread, for Foxglove, Lichtblick
// and PlotJuggler.
//   in     packets, the texts that consoles get, values and alarms of the base
//   out    messages to clients
//   invariants
//          a Feed decouples it: neither this thread nor a client can delay the loop
//   errors start(): as FoxgloveServer. figures(): losses of the feed and of clients, refusals
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <string_view>
#include <thread>

#include "basestation/publishers/feed/feed.hpp"
#include "basestation/publishers/foxglove/foxglove_server.hpp"
#include "basestation/service/publisher.hpp"

namespace pitwall::publishers::foxglove {

class FoxglovePublisher : public service::Publisher {
 public:
  static constexpr Duration kPollPeriod = milliseconds(100);
  // Fills in values and alarms of the base.
  using ReadStatus = std::function<void(ros_view::BaseStatus&, Instant)>;

  static Result<std::unique_ptr<FoxglovePublisher>, Problem> start(ServerConfig config,
                                                                   ReadStatus read_status = {});
  ~FoxglovePublisher() override;

  UdpAddress local() const { return server_->local(); }
  void packet(const service::CarService& car, const telemetry::Arrival& arrival) override;
  void publish(const service::CarService& car, Instant now) override;
  Instant due() const override { return read_status_ ? polled_at_ + kPollPeriod : Instant::max(); }
  void text(recorder::Topic topic, Instant at, std::string_view json) {
    feed_.text(topic, at, json);
  }
  std::optional<service::PublisherFigures> figures() const override;
  feed::Feed& feed() { return feed_; }

 private:
  FoxglovePublisher(std::unique_ptr<FoxgloveServer> server, ReadStatus read_status);
  void run();

  std::unique_ptr<FoxgloveServer> server_;  // used by the thread only
  ReadStatus read_status_;
  Instant polled_at_{};
  feed::Feed feed_;
  const std::vector<std::string> names_ = feed::channel_names();
  mutable std::mutex lock_;
  service::PublisherFigures figures_;  // under the lock
  std::thread thread_;
};

}  // namespace pitwall::publishers::foxglove

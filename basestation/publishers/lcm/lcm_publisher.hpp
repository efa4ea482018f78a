// LCM publisher of received states and messages: channels, types and bytes as in the LCM log of a
// recording.
//   in     packets, and the texts that consoles get
//   out    /car/GROUP and /base/TYPE, under a prefix where several cars share a wall
//   invariants
//          a thread of its own behind a Feed: a network that stalls costs this publisher its oldest
//          messages, counted by channel, and nobody anything else
//   errors figures(): dropped before they were published; failed: the network did not take them
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <atomic>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "basestation/publishers/feed/feed.hpp"
#include "basestation/publishers/lcm/lcm_link.hpp"
#include "basestation/service/publisher.hpp"
#include "protocol/recorder/lcm_encoder.hpp"

namespace pitwall::publishers::lcm {

class LcmPublisher : public service::Publisher {
 public:
  // False: it was not taken.
  using Publish = std::function<bool(const std::string&, std::span<const std::uint8_t>)>;

  static Result<std::unique_ptr<LcmPublisher>, Problem> start(const LcmUrl& url,
                                                              const recorder::ClockMap& clock,
                                                              std::string prefix);
  LcmPublisher(Publish publish, const recorder::ClockMap& clock, std::string prefix);
  ~LcmPublisher() override;

  void packet(const service::CarService& car, const telemetry::Arrival& arrival) override;
  void publish(const service::CarService&, Instant) override {}
  Instant due() const override { return {std::numeric_limits<std::int64_t>::max()}; }
  void text(recorder::Topic topic, Instant at, std::string_view json) {
    feed_.text(topic, at, json);
  }
  std::optional<service::PublisherFigures> figures() const override;
  feed::Feed& feed() { return feed_; }

 private:
  void run();
  void publish(const feed::Sample& sample);
  void publish(const feed::Reported& reported);
  void send(const recorder::Record& record);

  Publish publish_;
  recorder::LcmEncoder encoder_;
  std::vector<std::string> names_;
  feed::Feed feed_;
  std::vector<std::uint8_t> message_;
  std::atomic<std::uint64_t> sent_ = 0, failed_ = 0;
  std::thread thread_;
};

}  // namespace pitwall::publishers::lcm

// LCM publisher of received states and messages: channels, types and bytes as in the LCM log of a
// recording.
//   in     packets, and the texts that consoles get
//   out    /car/GROUP and /base/TYPE, with a prefix if one base serves several cars
//   invariants
//          it has its own thread behind a Feed: on a stalled network it loses its oldest messages,
//          counted by channel, and affects nothing else
//   errors figures(): dropped: lost before they were published; failed: refused by the network
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
  // Returns false if the network did not accept the message.
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

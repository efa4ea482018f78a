// Publisher of the figures of one car's service for /metrics, once a second.
//   in     the service; the other publishers of this car, the web server if there is one
//   out    a CarStatus on the board; the counters of the web server
//   cost   about ten microseconds a second; the text is made per request, in the requesting thread
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "basestation/publishers/metrics/board.hpp"
#include "basestation/publishers/web/web_server.hpp"
#include "basestation/service/publisher.hpp"

namespace pitwall::publishers::metrics {

// All of it outlives the publisher.
struct MetricsSources {
  std::size_t place = 0;  // of the car among those of this base
  const web::WebServer* server = nullptr;
  std::vector<const service::Publisher*> publishers{};
};

class MetricsPublisher : public service::Publisher {
 public:
  static constexpr Duration kEvery = seconds(1);

  MetricsPublisher(Board& board, MetricsSources sources)
      : board_(board), sources_(std::move(sources)) {}

  void publish(const service::CarService& car, Instant now) override;
  Instant due() const override { return due_; }

 private:
  Board& board_;
  MetricsSources sources_;
  Instant due_{};
};

CarStatus status_of(const service::CarService& car, const MetricsSources& sources, Instant now);

}  // namespace pitwall::publishers::metrics

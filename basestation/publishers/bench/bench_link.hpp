// Client of a bench server: reconnects, forwards the server's messages to consoles and the starts
// and stops of consoles to the server, and asks it for pages of runs and sweeps.
//   in     the path of the server's socket; requests of operators; requests for pages
//   out    texts for consoles and pages, published through BenchObserver; lines to the server
//   invariants
//          no run is started while the connected car reports that it is a real one. A stop is
//          always forwarded: it only ends a simulation
//          without a server a connection is tried each kRetry, and consoles show that there is
//          none. Messages of the server within kPublishPeriod are forwarded together: a lockstep
//          run is a hundred times faster than real time and must not flood consoles
//   errors a malformed line is counted and shown; reading goes on with the next line
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "basestation/publishers/bench/bench_state.hpp"
#include "basestation/publishers/bench/page_requests.hpp"
#include "basestation/service/publisher.hpp"
#include "protocol/transport/stream/line_socket.hpp"
#include "protocol/vocabulary/result.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::publishers::bench {

struct BenchRequest {
  bool start = false;  // false: stop
  std::string scenario;
  std::optional<std::uint64_t> seed;
  bool live = false;
};

// One line for the audit log.
std::string text_of(const BenchRequest& run_request);

struct BenchObserver {
  std::function<void(const Reported&, Instant)> publish;
  // Receives the server's refusal for the console that made the last request.
  std::function<void(std::uint8_t client, const Problem&, Instant)> refused;
  std::function<void(const PageAnswer&)> page;
};

class BenchLink : public service::Publisher {
 public:
  static constexpr Duration kRetry = seconds(1), kPublishPeriod = milliseconds(200);
  static constexpr Duration kPollPeriod = milliseconds(50);
  static constexpr Duration kPagePeriod = milliseconds(5);  // while a page is read part by part

  explicit BenchLink(std::string path) : path_(std::move(path)) {}
  void observe_by(BenchObserver observer) { observer_ = std::move(observer); }

  void publish(const service::CarService& car, Instant now) override;
  Instant due() const override { return polled_at_ + period(); }

  // `client`: the console that sends the request; `by`: its operator.
  Result<bool, Problem> ask(const BenchRequest& run_request, std::uint8_t client,
                            const std::string& by);
  // `request`: number by which BenchObserver::page answers, once.
  void ask_page(std::uint64_t request, const std::string& page);
  bool up() const { return socket_ && !socket_->closed(); }
  const BenchState& bench() const { return bench_; }

 private:
  void connect(Instant now);
  void receive(Instant now);
  void serve_pages(Instant now);
  Duration period() const { return pages_.empty() ? kPollPeriod : kPagePeriod; }
  std::string state_text() const;

  std::string path_;
  BenchObserver observer_;
  BenchState bench_;
  PageRequests pages_;
  std::optional<transport::LineSocket> socket_;
  std::optional<Instant> tried_, reported_;
  Instant polled_at_{};
  std::uint64_t too_long_ = 0, unexpected_parts_ = 0;
  std::uint8_t asker_ = 0;
  bool real_ = false;
  std::string problem_, state_reported_;
};

}  // namespace pitwall::publishers::bench

// SPDX-License-Identifier: Apache-2.0
#include "basestation/publishers/bench/bench_link.hpp"

#include <utility>

#include "protocol/json/json_text.hpp"

namespace pitwall::publishers::bench {
namespace {

using json::Object;

constexpr const char* kReal = "the connected car is real";
constexpr const char* kDown = "the bench server is not there";

}  // namespace

std::string text_of(const BenchRequest& run_request) {
  if (!run_request.start) return "bench: stop the run";
  return "bench: start " + run_request.scenario + ", " + (run_request.live ? "live" : "lockstep") +
         (run_request.seed ? ", seed " + std::to_string(*run_request.seed) : "");
}

Result<bool, Problem> BenchLink::ask(const BenchRequest& run_request, std::uint8_t client,
                                     const std::string& by) {
  if (run_request.start && real_) return Unexpected{Problem{"bench", kReal}};
  if (!up()) return Unexpected{Problem{"bench", kDown}};
  Object line;
  line.text("do", run_request.start ? "start" : "stop").text("by", by);
  if (run_request.start) {
    line.text("scenario", run_request.scenario)
        .text("mode", run_request.live ? "live" : "lockstep");
    line.json("seed", run_request.seed ? std::to_string(*run_request.seed) : "null");
  }
  asker_ = client;
  socket_->send(line.str());
  return true;
}

void BenchLink::ask_page(std::uint64_t request, const std::string& page) {
  pages_.ask(request, page);
}

void BenchLink::publish(const service::CarService& car, Instant now) {
  if (tried_ && now - polled_at_ < period()) return;
  polled_at_ = now;
  real_ = car.link().source() == link::Station::Source::kCar;
  if (!up() && (!tried_ || now - *tried_ >= kRetry)) connect(now);
  if (socket_) receive(now);
  serve_pages(now);
  if (!observer_.publish || (reported_ && now - *reported_ < kPublishPeriod)) return;
  reported_ = now;
  for (const Reported& reported : bench_.news()) observer_.publish(reported, now);
  std::string state = state_text();
  if (state == state_reported_) return;
  state_reported_ = state;
  observer_.publish({.type = "bench", .text = std::move(state)}, now);
}

void BenchLink::connect(Instant now) {
  tried_ = now;
  auto made = transport::LineSocket::connect(path_);
  if (!made) {
    problem_ = made.error().what;
    return;
  }
  problem_.clear();
  socket_.emplace(*std::move(made));
  bench_.connected();
}

void BenchLink::receive(Instant now) {
  for (const std::string& line : socket_->receive()) {
    if (const auto taken = bench_.take(line); !taken) problem_ = to_string(taken.error());
    if (const auto part = bench_.page_part()) {
      if (const auto taken = pages_.take(*part); !taken) {
        problem_ = to_string(taken.error());
        ++unexpected_parts_;
      }
    }
    if (auto refused = bench_.refusal(); refused && observer_.refused)
      observer_.refused(asker_, *refused, now);
  }
  if (!socket_->closed()) return;
  too_long_ += socket_->counters().too_long;
  socket_.reset();
  problem_ = "the server closed the connection";
}

void BenchLink::serve_pages(Instant now) {
  pages_.expire(now);
  if (!up()) pages_.disconnect(kDown);
  if (const auto line = pages_.next_line(now)) socket_->send(*line);
  for (const PageAnswer& answer : pages_.answers())
    if (observer_.page) observer_.page(answer);
}

std::string BenchLink::state_text() const {
  const char* const why = real_ ? kReal : up() ? "" : kDown;
  const std::uint64_t skipped = too_long_ + (socket_ ? socket_->counters().too_long : 0);
  return Object{}
      .text("type", "bench")
      .flag("up", up())
      .json("problem", problem_.empty() ? "null" : json::quoted(problem_))
      .number("malformed", bench_.counters().refused + unexpected_parts_ + skipped)
      .flag("may_start", *why == '\0')
      .json("why_not", *why == '\0' ? "null" : json::quoted(why))
      .str();
}

}  // namespace pitwall::publishers::bench

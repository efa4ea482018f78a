// SPDX-License-Identifier: Apache-2.0
#include "basestation/publishers/bench/bench_link.hpp"

#include <utility>

#include "protocol/json/json_text.hpp"

namespace pitwall::publishers::bench {
namespace {

using json::Object;

constexpr const char* kReal = "the connected car is real";
constexpr const char* kDown = "the bench desk is not there";

}  // namespace

std::string text_of(const BenchWish& wish) {
  if (!wish.start) return "bench: stop the run";
  return "bench: start " + wish.scenario + ", " + (wish.live ? "live" : "lockstep") +
         (wish.seed ? ", seed " + std::to_string(*wish.seed) : "");
}

Result<bool, Problem> BenchLink::ask(const BenchWish& wish, std::uint8_t client,
                                     const std::string& by) {
  if (wish.start && real_) return Unexpected{Problem{"bench", kReal}};
  if (!up()) return Unexpected{Problem{"bench", kDown}};
  Object line;
  line.text("do", wish.start ? "start" : "stop").text("by", by);
  if (wish.start) {
    line.text("scenario", wish.scenario).text("mode", wish.live ? "live" : "lockstep");
    line.json("seed", wish.seed ? std::to_string(*wish.seed) : "null");
  }
  asker_ = client;
  socket_->send(line.str());
  return true;
}

void BenchLink::publish(const service::CarService& car, Instant now) {
  if (tried_ && now - looked_ < kLook) return;
  looked_ = now;
  real_ = car.link().source() == link::Station::Source::kCar;
  if (!up() && (!tried_ || now - *tried_ >= kRetry)) connect(now);
  if (socket_) hear(now);
  if (!ears_.tell || (told_ && now - *told_ < kTellEvery)) return;
  told_ = now;
  for (const Told& told : book_.news()) ears_.tell(told, now);
  std::string state = state_text();
  if (state == state_told_) return;
  state_told_ = state;
  ears_.tell({.type = "bench", .text = std::move(state)}, now);
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
  book_.connected();
}

void BenchLink::hear(Instant now) {
  for (const std::string& line : socket_->receive()) {
    if (const auto taken = book_.take(line); !taken) problem_ = to_string(taken.error());
    if (auto refused = book_.refusal(); refused && ears_.refused)
      ears_.refused(asker_, *refused, now);
  }
  if (!socket_->closed()) return;
  too_long_ += socket_->counters().too_long;
  socket_.reset();
  problem_ = "the desk has hung up";
}

std::string BenchLink::state_text() const {
  const char* const why = real_ ? kReal : up() ? "" : kDown;
  const std::uint64_t skipped = too_long_ + (socket_ ? socket_->counters().too_long : 0);
  return Object{}
      .text("type", "bench")
      .flag("up", up())
      .json("problem", problem_.empty() ? "null" : json::quoted(problem_))
      .number("malformed", book_.counters().refused + skipped)
      .flag("may_start", *why == '\0')
      .json("why_not", *why == '\0' ? "null" : json::quoted(why))
      .str();
}

}  // namespace pitwall::publishers::bench

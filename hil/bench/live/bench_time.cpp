// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/live/bench_time.hpp"

#include <algorithm>

#include "hil/can_bus/clock_message.hpp"
#include "protocol/transport/clock.hpp"

namespace pitwall::bench {

Result<BenchTime, Problem> BenchTime::open(const std::string& file, const std::string& line) {
  auto keeper = transport::ClockKeeper::keep(file);
  if (!keeper) return Unexpected{keeper.error()};
  if (line.empty()) return BenchTime{*std::move(keeper), std::nullopt};
  auto opened = transport::SerialLine::open(line);
  if (!opened) return Unexpected{opened.error()};
  return BenchTime{*std::move(keeper), *std::move(opened)};
}

Result<std::optional<BenchTime>, Problem> BenchTime::of_run(const std::string& file,
                                                            const std::string& line) {
  if (file.empty()) return std::optional<BenchTime>{};
  if (const auto memory = transport::ClockMemory::open(file); memory && memory->is_locked()) {
    if (auto taken = transport::take_turns(); !taken) return Unexpected{taken.error()};
    return std::optional<BenchTime>{};
  }
  auto time = open(file, line);
  if (!time) return Unexpected{time.error()};
  return std::optional<BenchTime>{*std::move(time)};
}

void BenchTime::begin() {
  keeper_.begin();
  followed_ = keeper_.now();
  publish(followed_);
}

bool BenchTime::advance(Instant limit, Instant now) {
  if (!line_) return keeper_.advance(limit, now);
  if (now - reported_ >= kReportPeriod) {
    receive();
    publish(now);
  } else if (now - followed_ >= kBehind - kReportPeriod) {
    receive();
  }
  return keeper_.advance(std::min(limit, followed_ + kBehind), now);
}

void BenchTime::end() {
  keeper_.end();
  if (line_) publish(Instant::max());
}

void BenchTime::publish(Instant now) {
  reported_ = now;
  if (!line_) return;
  line_->send(can_bus::encode_clock(now));
  line_->flush();
}

void BenchTime::receive() {
  while (const auto word = line_->receive())
    if (const auto followed = can_bus::decode_clock(*word))
      followed_ = std::max(followed_, *followed);
}

}  // namespace pitwall::bench

// SPDX-License-Identifier: Apache-2.0
#include "hil/replay/replay_clock.hpp"

#include "protocol/json/json_text.hpp"
#include "protocol/transport/bench_clock/clock_memory.hpp"
#include "protocol/transport/clock.hpp"
#include "protocol/vocabulary/text.hpp"

namespace pitwall::replay {

Result<ReplayClock, Problem> ReplayClock::open(const std::string& source) {
  if (source == transport::kWallClock) return ReplayClock{std::string{}};
  if (const auto used = transport::use_clock(source); !used) return Unexpected{used.error()};
  return ReplayClock{source};
}

Result<bool, Problem> ReplayClock::begin() {
  if (is_wall()) return true;
  const auto memory = transport::ClockMemory::open(file_);
  if (!memory) return Unexpected{memory.error()};
  if (!memory->is_locked()) {
    auto kept = transport::KeptClock::keep(file_);
    if (!kept) return Unexpected{kept.error()};
    kept_.emplace(*std::move(kept));
  }
  begun_ = transport::monotonic_now();
  wall_begun_ = transport::wall_now();
  return transport::take_turns();
}

std::optional<transport::ClockWaits> ReplayClock::end() {
  if (is_wall()) return std::nullopt;
  transport::ClockWaits waits;
  if (kept_) {
    waits = kept_->end();
    waits.longest_at = Instant{} + (waits.longest_at - begun_);
  } else {
    waits.total = (transport::wall_now() - wall_begun_) - (transport::monotonic_now() - begun_);
  }
  return waits;
}

std::string to_text(const transport::ClockWaits& waits) {
  if (waits.count == 0)
    return formatted("bench time stood for %.2f s in all\n", waits.total.seconds());
  return formatted(
      "bench time stood %llu times, %.2f s in all, at the longest %.0f ms at %.2f s "
      "for %s\n",
      static_cast<unsigned long long>(waits.count), waits.total.seconds(),
      waits.longest.milliseconds(), waits.longest_at.seconds(),
      waits.longest_for.empty() ? "the replay" : waits.longest_for.c_str());
}

std::string to_json(const transport::ClockWaits& waits) {
  json::Object out;
  out.number("stood_s", waits.total.seconds());
  if (waits.count == 0) return out.str();
  return out.number("times", waits.count)
      .number("longest_ms", waits.longest.milliseconds())
      .number("longest_at_s", waits.longest_at.seconds())
      .text("longest_for", waits.longest_for)
      .str();
}

}  // namespace pitwall::replay

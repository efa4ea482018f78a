// SPDX-License-Identifier: Apache-2.0
#include "hil/link/link_emulator.hpp"

#include <algorithm>
#include <utility>

#include "hil/link/trace.hpp"
#include "protocol/vocabulary/check.hpp"

namespace pitwall::link {
namespace {

// Of the seed; 0 is that of the fades.
enum Stream : std::uint64_t { kLoss = 1, kJitter, kReorder, kDuplicate, kCorrupt };

bool blacked_out(const std::vector<Blackout>& blackouts, Instant at) {
  return std::ranges::any_of(blackouts, [at](const Blackout& b) {
    if (at < b.from) return false;
    const Duration since = at - b.from;
    return (b.every > Duration{} ? Duration{since.ns % b.every.ns} : since) < b.length;
  });
}

}  // namespace

LinkEmulator::LinkEmulator(LinkParams params, std::uint64_t seed)
    : params_(std::move(params)),
      fades_(params_.fades, seed),
      query_fades_(fades_),
      loss_(seed, kLoss),
      jitter_(seed, kJitter),
      reorder_(seed, kReorder),
      duplicate_(seed, kDuplicate),
      corrupt_(seed, kCorrupt) {
  CHECK(params_.rate_bytes_per_s >= 0.0);
  CHECK(params_.delay >= Duration{} && params_.jitter >= Duration{});
}

void LinkEmulator::offer(std::span<const std::uint8_t> bytes, Instant now, std::uint64_t tag) {
  CHECK(now >= last_offer_);
  last_offer_ = now;
  ++counters_.offered;
  const auto on_air = through_the_queue(bytes.size() + params_.overhead_bytes, now);
  if (!on_air) return;
  const bool survived = survives(*on_air);
  const Instant arrives = arrival_of(*on_air);
  const bool twice = duplicate_.uniform() < params_.duplicate;
  const bool corrupted = corrupt_.uniform() < params_.corrupt;
  if (!survived) return;
  Datagram datagram{{bytes.begin(), bytes.end()}, now, arrives, tag};
  if (corrupted) corrupt(datagram.bytes);
  if (twice) {
    ++counters_.duplicated;
    send_off(datagram);
  }
  send_off(std::move(datagram));
}

// When its last byte leaves; none: the queue is full.
std::optional<Instant> LinkEmulator::through_the_queue(std::size_t size, Instant now) {
  if (params_.rate_bytes_per_s > 0.0 && queued_bytes(now) + size > params_.queue_bytes) {
    ++counters_.queue_full;
    return std::nullopt;
  }
  counters_.bytes += size;
  const Duration sending = params_.rate_bytes_per_s > 0.0
                               ? from_seconds(static_cast<double>(size) / params_.rate_bytes_per_s)
                               : Duration{};
  air_free_ = std::max(air_free_, now) + sending;
  return air_free_;
}

// Draws for every effect, whatever the others did: a change of one moves no other's stream.
bool LinkEmulator::survives(Instant on_air) {
  const bool bad = fades_.bad(on_air);
  const double in_fade = loss_.uniform(), alone = loss_.uniform(), recorded = loss_.uniform(),
               here = loss_.uniform();
  std::uint64_t* reason = nullptr;
  if (blacked_out(params_.blackouts, on_air)) {
    reason = &counters_.blacked_out;
  } else if (bad && in_fade < params_.fades.loss_bad) {
    reason = &counters_.faded;
  } else if (recorded < loss_over_time(params_.trace, on_air)) {
    reason = &counters_.faded;
  } else if (!bad && in_fade < params_.fades.loss_good) {
    reason = &counters_.lost;
  } else if (alone < params_.loss || here < loss_at_station(params_.trace, station_m_)) {
    reason = &counters_.lost;
  }
  if (reason) ++*reason;
  return reason == nullptr;
}

Instant LinkEmulator::arrival_of(Instant on_air) {
  const Duration jitter = from_seconds(params_.jitter.seconds() * jitter_.uniform());
  const bool held_back = reorder_.uniform() < params_.reorder;
  const Instant arrives = std::max(last_in_order_, on_air + params_.delay + jitter);
  if (held_back) return arrives + params_.reorder_by;
  last_in_order_ = arrives;
  return arrives;
}

// One bit, anywhere.
void LinkEmulator::corrupt(std::vector<std::uint8_t>& bytes) {
  const std::uint64_t drawn = corrupt_.next();
  if (bytes.empty()) return;
  const std::uint64_t bit = drawn % (bytes.size() * 8);
  bytes[bit / 8] = static_cast<std::uint8_t>(bytes[bit / 8] ^ (1U << (bit % 8)));
  ++counters_.corrupted;
}

void LinkEmulator::send_off(Datagram datagram) {
  const auto later = [](const Datagram& d, Instant at) { return d.arrives <= at; };
  const auto place =
      std::lower_bound(under_way_.begin(), under_way_.end(), datagram.arrives, later);
  counters_.reordered += static_cast<std::uint64_t>(under_way_.end() - place);
  under_way_.insert(place, std::move(datagram));
}

std::optional<Datagram> LinkEmulator::take(Instant now) {
  if (under_way_.empty() || under_way_.front().arrives > now) return std::nullopt;
  Datagram datagram = std::move(under_way_.front());
  under_way_.pop_front();
  ++counters_.delivered;
  return datagram;
}

std::optional<Instant> LinkEmulator::next() const {
  if (under_way_.empty()) return std::nullopt;
  return under_way_.front().arrives;
}

bool LinkEmulator::faded(Instant at) {
  return query_fades_.bad(at) || blacked_out(params_.blackouts, at) ||
         loss_over_time(params_.trace, at) >= 1.0;
}

std::size_t LinkEmulator::queued_bytes(Instant now) const {
  if (air_free_ <= now) return 0;
  return static_cast<std::size_t>((air_free_ - now).seconds() * params_.rate_bytes_per_s + 0.5);
}

}  // namespace pitwall::link

// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/flow/path_budget.hpp"

#include <algorithm>
#include <cmath>

#include "protocol/telemetry/packet/header.hpp"
#include "protocol/vocabulary/check.hpp"

namespace pitwall::telemetry {

namespace {

constexpr std::int64_t kByte = kNanosecondsPerSecond;  // tokens of one byte
constexpr std::int64_t kOverhead = kIpUdpOverhead, kLeast = PathBudget::kLeastLargest;
constexpr double kSlot_s = 0.02;         // of the rate, by default, in the largest packet
constexpr double kShareDepth_s = 0.03;   // a slot that comes late loses nothing of its share
constexpr Duration kLong = seconds(60);  // after which everything is full anyway
constexpr double kMostBytes_per_s = 1e8, kLeastShare_per_s = 100.0, kMostPackets_per_s = 1e5;

std::int64_t whole(double bytes) { return static_cast<std::int64_t>(bytes); }

bool sensible(double value, double least, double most) { return value >= least && value <= most; }

Unexpected<Problem> problem(std::string what) {
  return Unexpected{Problem{"radio budget", std::move(what)}};
}

// Of the distance of two packets: 1 + floor(a tenth of the rate + this) must stay the law's number.
double early_share(double packets_per_s) {
  const double in_tenth = packets_per_s / 10.0;
  return (std::floor(in_tenth) + 1.0 - in_tenth) / 2.0;
}

}  // namespace

Result<PathBudget, Problem> PathBudget::make(const BudgetParams& params) {
  if (!sensible(params.bytes_per_s, kLeastShare_per_s, kMostBytes_per_s))
    return problem("bytes_per_s out of range");
  if (!sensible(params.packets_per_s, 1.0, kMostPackets_per_s)) {
    return problem("packets_per_s out of range");
  }
  if (!sensible(params.safety_bytes_per_s, kLeastShare_per_s, params.bytes_per_s)) {
    return problem("safety_bytes_per_s must be at least 100 and at most bytes_per_s");
  }
  if (params.largest_payload > kMaxDatagram) return problem("largest_payload above a datagram");

  PathBudget budget(params);
  const std::int64_t rate = whole(params.bytes_per_s);
  const std::int64_t share =
      std::max<std::int64_t>(1, whole(std::ceil(params.safety_bytes_per_s * kShareDepth_s)));
  const std::int64_t least = share + kLeast;
  budget.largest_payload_ =
      params.largest_payload > 0
          ? static_cast<std::int64_t>(params.largest_payload)
          : std::clamp<std::int64_t>(whole(params.bytes_per_s * kSlot_s) - kOverhead, least,
                                     kMaxDatagram);
  if (budget.largest_payload_ < least) {
    return problem("largest_payload holds no key exchange beside the safety share: at least " +
                   std::to_string(least) + " bytes");
  }
  const std::int64_t packet = budget.largest_payload_ + kOverhead;
  budget.share_rate_ = whole(params.safety_bytes_per_s);
  budget.whole_rate_ = rate - packet;
  if (budget.whole_rate_ < budget.share_rate_) {
    return problem("bytes_per_s does not carry safety_bytes_per_s and one largest packet of " +
                   std::to_string(packet) + " bytes in a second");
  }
  budget.scaled_rate_ = budget.whole_rate_;
  budget.full_ = {share * kByte, (packet - share) * kByte};
  const double spacing_ns = static_cast<double>(kNanosecondsPerSecond) / params.packets_per_s;
  budget.spacing_ = {whole(std::ceil(spacing_ns))};
  budget.early_ = {whole(spacing_ns * early_share(params.packets_per_s))};
  return budget;
}

void PathBudget::begin(Instant now) const {
  if (begun_) return;
  begun_ = true;
  at_time_ = now;
  next_packet_ = now + spacing_ + early_;
}

PathBudget::Levels PathBudget::levels(Instant now) const {
  const std::int64_t passed = std::clamp(now - at_time_, Duration{}, kLong).ns;
  const std::int64_t share = at_.share + share_rate_ * passed;
  const std::int64_t spilled = std::max<std::int64_t>(0, share - full_.share);
  const std::int64_t rest = at_.rest + (scaled_rate_ - share_rate_) * passed + spilled;
  return {share - spilled, std::min(rest, full_.rest)};
}

std::size_t PathBudget::room_for_safety(Instant now) const {
  begin(now);
  if (!spaced(now)) return 0;
  const Levels l = levels(now);
  return static_cast<std::size_t>(
      std::max<std::int64_t>(0, (l.share + l.rest) / kByte - kOverhead));
}

std::size_t PathBudget::room_for_all(Instant now) const {
  begin(now);
  if (!spaced(now)) return 0;
  return static_cast<std::size_t>(std::max<std::int64_t>(0, levels(now).rest / kByte - kOverhead));
}

std::size_t PathBudget::room_beside(std::size_t safety_payload, Instant now) const {
  begin(now);
  if (safety_payload == 0) return room_for_all(now);
  if (safety_payload > room_for_safety(now)) return 0;
  const Levels l = levels(now);
  const std::int64_t safety = (static_cast<std::int64_t>(safety_payload) + kOverhead) * kByte;
  return static_cast<std::size_t>((l.rest + std::min(safety, l.share)) / kByte - kOverhead);
}

void PathBudget::spend(std::size_t payload, std::size_t safety_payload, Instant now) {
  CHECK(safety_payload <= payload && payload > 0);
  CHECK(payload <= room_beside(safety_payload, now));
  const Levels l = levels(now);
  const std::int64_t bytes = static_cast<std::int64_t>(payload) + kOverhead;
  const std::int64_t safety =
      safety_payload > 0 ? static_cast<std::int64_t>(safety_payload) + kOverhead : 0;
  const std::int64_t of_share = std::min(safety * kByte, l.share);
  at_ = {l.share - of_share, l.rest - (bytes * kByte - of_share)};
  at_time_ = std::max(at_time_, now);
  next_packet_ = std::max(next_packet_, now) + spacing_;
  counters_.bytes += static_cast<std::uint64_t>(bytes);
  counters_.safety_bytes += static_cast<std::uint64_t>(safety);
  ++counters_.packets;
}

void PathBudget::scale(double factor, Instant now) {
  begin(now);
  CHECK(factor > 0.0 && factor <= 1.0);
  at_ = levels(now);
  at_time_ = std::max(at_time_, now);
  scaled_rate_ = std::max(share_rate_, whole(static_cast<double>(whole_rate_) * factor));
}

}  // namespace pitwall::telemetry

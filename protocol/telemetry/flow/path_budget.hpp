// Token bucket of one path at one end: bytes and packets per second, IP and UDP overhead counted,
// with a share that only safety may use. Nothing bypasses it: acknowledgements, key exchange and
// repetitions are spent from it like all else.
//   invariants
//          in every window of 100 ms (at any start) bytes <= rate / 10 + one largest packet and
//          packets <= packet rate / 10 + 1; in every window of 1 s bytes <= rate
//          what safety may use is never less than its share; others never touch the share
//          it begins empty when it is first asked: what was spent before a restart is not known
//   units  bytes and packets per second; sizes are UDP payload, the overhead is added here
//   errors make(): Problem where the share, the largest packet or the rate contradict each other
//   source token bucket, split in two; depth is latency, so both together hold one largest packet.
//          They fill with the rate less that packet per second, so any window w sees at most
//          rate w + packet (1 - w / 1 s). Packets keep a schedule of 1 / packet rate, and may be
//          early by half of what rounding their number in 100 ms down leaves: a loop that ticks
//          with jitter loses none
//
//        rate - packet -+-> share (safety's rate) --- full: spills over --> rest
//                       +-> rest (what is left)
//        safety takes from the share, then from the rest; all else from the rest alone
//
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

#include "protocol/vocabulary/result.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::telemetry {

struct BudgetParams {
  double bytes_per_s = 32'000.0;  // 256 kbit/s
  double packets_per_s = 100.0;
  double safety_bytes_per_s = 4'400.0;  // reserved
  std::size_t largest_payload = 0;      // 0: one slot of the rate, at most kMaxDatagram
};

struct BudgetCounters {
  std::uint64_t bytes = 0, packets = 0;  // spent, with overhead
  std::uint64_t safety_bytes = 0;
  std::uint64_t refused = 0;  // times that something wanted to go and could not
};

class PathBudget {
 public:
  // A message of the key exchange must always fit beside the share.
  static constexpr std::size_t kLeastLargest = 192;
  // What never comes by waiting: later than any clock.

  static Result<PathBudget, Problem> make(const BudgetParams& params);

  // UDP payload that may go now in one packet that is all safety's, and in one that has none of
  // it. Zero: no packet.
  std::size_t room_for_safety(Instant now) const;
  std::size_t room_for_all(Instant now) const;
  // Payload of a whole packet of which `safety_payload` is safety's; the overhead then is, too.
  // Zero: not even the safety part may go.
  std::size_t room_beside(std::size_t safety_payload, Instant now) const;
  // A packet went. CHECKs that there was room for it. `safety_payload`: how much of it was
  // safety's.
  void spend(std::size_t payload, std::size_t safety_payload, Instant now);
  void note_refused() { ++counters_.refused; }
  // Of the rate: what rate control leaves of it, (0, 1]; safety's share is never scaled.
  void scale(double factor, Instant now);
  // Bytes per second that come at present: the rate as it is scaled, less a largest packet.
  double present_rate() const { return static_cast<double>(scaled_rate_); }
  // The earliest time at which a packet of this payload may go as all else; Instant::max() if it
  // is too large.
  Instant due(std::size_t payload, Instant now) const;

  std::size_t largest_payload() const { return static_cast<std::size_t>(largest_payload_); }
  const BudgetParams& params() const { return params_; }
  const BudgetCounters& counters() const { return counters_; }

 private:
  // Tokens in billionths of a byte, so that bytes per second times nanoseconds is exact.
  struct Levels {
    std::int64_t share = 0, rest = 0;
  };

  explicit PathBudget(const BudgetParams& params) : params_(params) {}
  Levels levels(Instant now) const;
  bool spaced(Instant now) const { return now >= next_packet_ - early_; }
  void begin(Instant now) const;

  BudgetParams params_;
  BudgetCounters counters_;
  std::int64_t largest_payload_ = 0;
  std::int64_t share_rate_ = 0, whole_rate_ = 0, scaled_rate_ = 0;  // bytes per second
  Levels full_, at_;
  // Asking is what begins it, hence mutable.
  mutable bool begun_ = false;
  mutable Instant at_time_{}, next_packet_{};
  Duration spacing_{}, early_{};
};

}  // namespace pitwall::telemetry

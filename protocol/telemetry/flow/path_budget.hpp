// Token bucket of one radio path at one end: bytes and packets per second, IP and UDP overhead
// included, with a share reserved for safety content. All traffic is paid from it, including
// acknowledgements, key exchange and repetitions.
//   invariants
//          in every window of 100 ms (at any start) bytes <= rate / 10 + one largest packet and
//          packets <= packet rate / 10 + 1; in every window of 1 s bytes <= rate
//          safety may always use at least its share; other content never uses the share
//          the bucket is empty at the first call, because the use before a restart is not known
//   units  bytes and packets per second; sizes are UDP payload, the overhead is added here
//   errors make(): Problem if a value is out of range, or if the share, the largest packet and the
//          rate contradict each other
//   source token bucket, split in two. Depth is latency, so both parts together hold one largest
//          packet. They fill at the rate minus that packet per second, so any window w has at most
//          rate w + packet (1 - w / 1 s). Packets keep a schedule of 1 / packet rate. A packet may
//          be early by half of what rounding down their number in 100 ms leaves, so that a loop
//          with jitter loses no packet
//
//        rate - packet -+-> share (safety rate) --- overflow if full --> rest
//                       +-> rest (remaining rate)
//        safety content takes from the share, then from the rest; other content from the rest only
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
  std::uint64_t refused = 0;  // requests that found no room
};

class PathBudget {
 public:
  // A message of the key exchange must always fit beside the share.
  static constexpr std::size_t kLeastLargest = 192;

  static Result<PathBudget, Problem> make(const BudgetParams& params);

  // UDP payload that may be sent now in one packet with safety content only, and in one without
  // safety content. Zero: no packet may be sent.
  std::size_t room_for_safety(Instant now) const;
  std::size_t room_for_all(Instant now) const;
  // UDP payload of a whole packet with `safety_payload` bytes of safety content; the overhead then
  // counts as safety content too. Zero: not even the safety part may be sent.
  std::size_t room_beside(std::size_t safety_payload, Instant now) const;
  // Pays for a packet with `safety_payload` bytes of safety content. CHECKs that it has room.
  void spend(std::size_t payload, std::size_t safety_payload, Instant now);
  void note_refused() { ++counters_.refused; }
  // Scales the rate by the factor of rate control, (0, 1]; the safety share is never scaled.
  void scale(double factor, Instant now);
  // Bytes per second at present: the scaled value of the rate minus a largest packet.
  double present_rate() const { return static_cast<double>(scaled_rate_); }

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
  // Mutable because the first query starts the bucket.
  mutable bool begun_ = false;
  mutable Instant at_time_{}, next_packet_{};
  Duration spacing_{}, early_{};
};

}  // namespace pitwall::telemetry

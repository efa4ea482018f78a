// Handshake rate limiter: it limits the replies to one address and to all addresses together, so
// that no sender can use up the budget of an end.
//   in     the address to reply to, the time
//   out    whether the reply may be sent
//   cost   constant; no allocation
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "protocol/vocabulary/time.hpp"
#include "protocol/vocabulary/udp_address.hpp"

namespace pitwall::telemetry {

// Rate limit: at most `per_second` on average and `at_once` in a burst.
class Allowance {
 public:
  explicit constexpr Allowance(std::int64_t per_second) : Allowance(per_second, per_second) {}
  constexpr Allowance(std::int64_t per_second, std::int64_t at_once)
      : spacing_{kNanosecondsPerSecond / per_second}, left_(at_once), most_(at_once) {}

  constexpr bool has(Instant now) const { return left_ > 0 || now - since_ >= spacing_; }
  constexpr bool take(Instant now) {
    const std::int64_t more = (now - since_) / spacing_;
    if (more > 0) {
      left_ = std::min(left_ + more, most_);
      since_ = since_ + spacing_ * more;
    }
    if (left_ == 0) return false;
    --left_;
    return true;
  }

 private:
  Duration spacing_;
  std::int64_t left_, most_;
  Instant since_{};
};

class ReplyLimiter {
 public:
  constexpr ReplyLimiter(std::int64_t per_source, std::int64_t in_all)
      : per_source_(per_source), in_all_(in_all) {}

  constexpr bool take(UdpAddress to, Instant now) {
    Source& source = source_of(to);
    source.used = now;
    return source.allowance.take(now) && in_all_.take(now);
  }

 private:
  struct Source {
    UdpAddress address;
    Allowance allowance{1};
    Instant used{};
  };

  // The entry of this address; a new address replaces the least recently used entry.
  constexpr Source& source_of(UdpAddress to) {
    Source* oldest = &sources_[0];
    for (Source& source : sources_) {
      if (source.address == to) return source;
      if (source.used < oldest->used) oldest = &source;
    }
    *oldest = {.address = to, .allowance = Allowance(per_source_)};
    return *oldest;
  }

  std::int64_t per_source_;
  Allowance in_all_;
  std::array<Source, 16> sources_{};
};

}  // namespace pitwall::telemetry

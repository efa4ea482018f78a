// How many openings an end works on, and when it asks for a proof of the sender's address first.
//   law    at most kKnocksPerSecond cost an agreement of keys; after the first kFreeKnocks of a
//          burst only those that carry the cookie of their address do. At most kCookiesPerSecond
//          are told a cookie; what is beyond is not even answered
//   source WireGuard, a whitepaper, 5.3 and 5.4.7
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "protocol/telemetry/session/address.hpp"
#include "protocol/telemetry/session/exchange.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::telemetry {

// At most `per_second`, and as many at once.
class Allowance {
 public:
  explicit constexpr Allowance(std::int64_t per_second)
      : spacing_{kNanosecondsPerSecond / per_second}, left_(per_second), most_(per_second) {}

  constexpr std::int64_t left(Instant now) {
    const std::int64_t more = (now - since_) / spacing_;
    if (more > 0) {
      left_ = left_ + more < most_ ? left_ + more : most_;
      since_ = since_ + spacing_ * more;
    }
    return left_;
  }
  constexpr bool take(Instant now) {
    if (left(now) == 0) return false;
    --left_;
    return true;
  }

 private:
  Duration spacing_;
  std::int64_t left_, most_;
  Instant since_{};
};

class KnockGuard {
 public:
  static constexpr std::int64_t kKnocksPerSecond = 20, kFreeKnocks = 10, kCookiesPerSecond = 50;
  static constexpr Duration kCookieLife = seconds(60);  // the one before is taken as long again

  enum class Answer : std::uint8_t { kLetIn, kAskCookie, kNothing };
  Answer judge(Bytes opening, std::uint8_t path, Address from, Instant now, Randomness& randomness);
  // Of the present secret; after judge().
  Cookie cookie_for(std::uint8_t path, Address from) const;

 private:
  Cookie cookie_with(const Key& secret, std::uint8_t path, Address from) const;
  void renew(Instant now, Randomness& randomness);

  Allowance knocks_{kKnocksPerSecond}, cookies_{kCookiesPerSecond};
  Key secret_, old_secret_;
  Instant renewed_{};
  bool ever_ = false;
};

}  // namespace pitwall::telemetry

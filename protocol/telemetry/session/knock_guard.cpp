// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/session/knock_guard.hpp"

#include <array>

#include "protocol/telemetry/little_endian.hpp"

namespace pitwall::telemetry {

KnockGuard::Answer KnockGuard::judge(Bytes opening, std::uint8_t path, Address from, Instant now,
                                     Randomness& randomness) {
  renew(now, randomness);
  if (knocks_.left(now) > kKnocksPerSecond - kFreeKnocks) {
    return knocks_.take(now) ? Answer::kLetIn : Answer::kNothing;
  }
  const Bytes shown = cookie_part(opening);
  if (same(shown, cookie_with(secret_, path, from)) ||
      same(shown, cookie_with(old_secret_, path, from))) {
    return knocks_.take(now) ? Answer::kLetIn : Answer::kNothing;
  }
  return cookies_.take(now) ? Answer::kAskCookie : Answer::kNothing;
}

Cookie KnockGuard::cookie_for(std::uint8_t path, Address from) const {
  return cookie_with(secret_, path, from);
}

Cookie KnockGuard::cookie_with(const Key& secret, std::uint8_t path, Address from) const {
  std::array<std::uint8_t, sizeof(from.ip) + sizeof(from.port) + sizeof(path)> place{};
  store<std::uint32_t>(place, 0, from.ip);
  store<std::uint16_t>(place, sizeof(from.ip), from.port);
  place.back() = path;
  return keyed_tag(secret, {place});
}

void KnockGuard::renew(Instant now, Randomness& randomness) {
  if (ever_ && now - renewed_ < kCookieLife) return;
  if (ever_ && now - renewed_ < 2 * kCookieLife) {
    old_secret_ = secret_;
  } else {
    randomness.fill(old_secret_.bytes);
  }
  randomness.fill(secret_.bytes);
  renewed_ = now;
  ever_ = true;
}

}  // namespace pitwall::telemetry

// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/session/knock_guard.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

namespace pitwall::telemetry {
namespace {

using Answer = KnockGuard::Answer;
constexpr Address kHere{.ip = 1, .port = 1}, kThere{.ip = 1, .port = 2};

struct Door {
  KnockGuard guard;
  SeededRandomness randomness{1};
  OpeningBytes opening{};

  Answer knock(Address from, Instant now) { return guard.judge(opening, 0, from, now, randomness); }
  void show(const Cookie& cookie) {
    std::copy(cookie.begin(), cookie.end(), opening.end() - kCookieSize);
  }
  // Knocks until a cookie is asked for.
  void crowd(Instant now) {
    while (knock(kThere, now) != Answer::kAskCookie) continue;
  }
};

TEST(KnockGuard, AFewMayComeInAtOnceTheOthersProveTheirAddress) {
  Door door;
  const Instant now{seconds(5).ns};
  for (int i = 0; i < KnockGuard::kFreeKnocks; ++i)
    EXPECT_EQ(door.knock(kHere, now), Answer::kLetIn);
  EXPECT_EQ(door.knock(kHere, now), Answer::kAskCookie);
  door.show(door.guard.cookie_for(0, kHere));
  EXPECT_EQ(door.knock(kHere, now), Answer::kLetIn);
  EXPECT_EQ(door.knock(kThere, now), Answer::kAskCookie) << "of another address";
}

TEST(KnockGuard, NoMoreThanItsRateWhateverTheyShow) {
  Door door;
  door.crowd(Instant{seconds(5).ns});
  door.show(door.guard.cookie_for(0, kHere));
  int let_in = 0, asked = 0;
  for (int ms = 0; ms < 10'000; ++ms) {
    const Instant now{seconds(6).ns + milliseconds(ms).ns};
    if (door.knock(kHere, now) == Answer::kLetIn) ++let_in;
    if (door.knock(kThere, now) == Answer::kAskCookie) ++asked;
  }
  EXPECT_LE(let_in, 11 * KnockGuard::kKnocksPerSecond);
  EXPECT_GE(let_in, 9 * KnockGuard::kKnocksPerSecond);
  EXPECT_LE(asked, 11 * KnockGuard::kCookiesPerSecond);
}

TEST(KnockGuard, ACookieLastsForOneRenewalAndNotForTwo) {
  for (const int renewals : {0, 1, 2}) {
    Door door;
    Instant now{seconds(5).ns};
    door.crowd(now);
    door.show(door.guard.cookie_for(0, kHere));
    for (int i = 0; i < renewals; ++i) {
      now += KnockGuard::kCookieLife;
      door.knock(kThere, now);
    }
    const Cookie shown = [&] {
      Cookie cookie{};
      std::copy_n(cookie_part(door.opening).begin(), kCookieSize, cookie.begin());
      return cookie;
    }();
    door.show({});
    door.crowd(now);
    door.show(shown);
    EXPECT_EQ(door.knock(kHere, now) == Answer::kLetIn, renewals < 2) << renewals;
  }
}

}  // namespace
}  // namespace pitwall::telemetry

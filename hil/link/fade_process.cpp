// SPDX-License-Identifier: Apache-2.0
#include "hil/link/fade_process.hpp"

#include <algorithm>
#include <cmath>

#include "protocol/vocabulary/check.hpp"

namespace pitwall::link {
namespace {

constexpr std::uint64_t kStream = 0;  // of the seed; the emulator's other effects have others

}  // namespace

FadeProcess::FadeProcess(const Fades& fades, std::uint64_t seed)
    : mean_good_(fades.mean_good), mean_bad_(fades.mean_bad), random_(seed, kStream) {
  CHECK(mean_good_ >= Duration{} && mean_bad_ >= Duration{});
  if (mean_bad_ == Duration{} || mean_good_ == Duration{}) {
    bad_ = mean_bad_ > Duration{};  // without good times the fade never ends
    until_ = Instant::max();
    return;
  }
  bad_ = random_.uniform() < fades.share_bad();
  until_ = Instant{} + draw(bad_ ? mean_bad_ : mean_good_);
}

bool FadeProcess::bad(Instant at) {
  while (until_ <= at) {
    bad_ = !bad_;
    until_ += draw(bad_ ? mean_bad_ : mean_good_);
  }
  return bad_;
}

// At least a nanosecond, so that time always moves.
Duration FadeProcess::draw(Duration mean) {
  const Duration drawn = from_seconds(-std::log(1.0 - random_.uniform()) * mean.seconds());
  return std::max(drawn, nanoseconds(1));
}

}  // namespace pitwall::link

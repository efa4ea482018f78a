// SPDX-License-Identifier: Apache-2.0
#include "basestation/alarms/rate.hpp"

namespace pitwall::alarms {

void AlarmRate::add(Instant at) {
  times_[ever_++ % kKept] = at;
  if (count_ < kKept) ++count_;
}

bool AlarmRate::advance(Instant now) {
  while (count_ > 0 && now - times_[(ever_ - count_) % kKept] >= kRateWindow) --count_;
  const bool before = flood_;
  flood_ = flood_ ? count_ > kFloodOver : count_ > kFloodAbove;
  return flood_ != before;
}

}  // namespace pitwall::alarms

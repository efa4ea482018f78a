// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/radio/rate_window.hpp"

#include <algorithm>

namespace pitwall::link {

void RateWindow::sent(std::size_t bytes, Instant at) {
  while (!inside_.empty() && inside_.front().at + length_ <= at) {
    inside_bytes_ -= inside_.front().bytes;
    inside_.pop_front();
  }
  inside_.push_back({at, bytes});
  inside_bytes_ += bytes;
  bytes_ += bytes;
  ++packets_;
  worst_bytes_ = std::max(worst_bytes_, inside_bytes_);
  worst_packets_ = std::max<std::uint64_t>(worst_packets_, inside_.size());
}

}  // namespace pitwall::link

// Buffer of stream bytes that are not yet assigned to a frame, and the counters of a stream. Pieces
// of any size are added at the back; bytes are taken off at the front. No allocation.
//   invariants
//          every byte fits, provided that drain() takes bytes off when kMaxFrame bytes are unread
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "protocol/vocabulary/check.hpp"

namespace pitwall::gnss {

struct StreamCounters {
  std::uint64_t bytes = 0, frames = 0;
  std::uint64_t ascii_frames = 0;   // part of `frames`
  std::uint64_t garbage_bytes = 0;  // bytes in no frame
  std::uint64_t resyncs = 0;        // number of garbage runs, after a frame or at the start
  std::uint64_t bad_crc = 0;
  std::uint64_t oversize = 0;    // longer than kMaxFrameBytes according to the header
  std::uint64_t bad_header = 0;  // a header that is not valid in the format
  std::uint64_t unexpected = 0;  // a valid header of an output that is not configured
};

template <std::size_t kMaxFrame>
class StreamWindow {
 public:
  // Adds the bytes piece by piece as they fit, and calls drain() after each piece.
  template <class Drain>
  void feed(std::span<const std::uint8_t> bytes, Drain&& drain) {
    while (!bytes.empty()) {
      const std::size_t n = std::min(bytes.size(), buffer_.size() - size_);
      CHECK(n > 0);
      std::copy_n(bytes.begin(), n, buffer_.begin() + static_cast<std::ptrdiff_t>(size_));
      size_ += n;
      bytes = bytes.subspan(n);
      drain();
      compact();
    }
  }

  // Valid until the next feed(), even after take_off().
  std::span<const std::uint8_t> unread() const {
    return std::span{buffer_}.subspan(begin_, size_ - begin_);
  }
  void take_off(std::size_t n) { begin_ += n; }

 private:
  void compact() {
    std::copy(buffer_.begin() + static_cast<std::ptrdiff_t>(begin_),
              buffer_.begin() + static_cast<std::ptrdiff_t>(size_), buffer_.begin());
    size_ -= begin_;
    begin_ = 0;
  }

  std::array<std::uint8_t, 2 * kMaxFrame> buffer_{};
  std::size_t begin_ = 0, size_ = 0;  // unread bytes are [begin_, size_)
};

}  // namespace pitwall::gnss

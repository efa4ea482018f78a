// The bytes of a stream that are not yet decided: fed at the back in pieces of any size, looked at
// as a whole, taken off at the front; and what is counted of a stream. No allocation.
//   invariants
//          as long as the drain decides whenever kMaxFrame bytes are unread, every byte fits
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
  std::uint64_t ascii_frames = 0;   // of the frames
  std::uint64_t garbage_bytes = 0;  // in no frame
  std::uint64_t resyncs = 0;        // times that garbage began: after a frame, or at the start
  std::uint64_t bad_crc = 0;
  std::uint64_t oversize = 0;    // longer than kMaxFrameBytes by its own header
  std::uint64_t bad_header = 0;  // a header that the format does not know
  std::uint64_t unexpected = 0;  // a good header of an output that nobody asked for
};

template <std::size_t kMaxFrame>
class StreamWindow {
 public:
  // Calls drain() after each piece that fitted; it takes off what it has decided.
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

  // What lies there stays where it is until the next feed, also when it is taken off.
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

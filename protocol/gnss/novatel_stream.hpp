// Cuts NovAtel frames out of a byte stream that may start anywhere, carry other text, be damaged.
//   in     bytes in pieces of any size
//   out    every frame with a correct CRC, once, in order, however the bytes are cut
//   errors counters; a damaged frame costs nothing but itself: the search resumes at the byte
//          after its sync
//   bound  frames longer than kMaxFrameBytes are counted and skipped; no allocation
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "protocol/gnss/novatel_codec.hpp"

namespace pitwall::gnss {

struct StreamCounters {
  std::uint64_t bytes = 0, frames = 0;
  std::uint64_t garbage_bytes = 0;  // in no frame
  std::uint64_t bad_crc = 0;
  std::uint64_t oversize = 0;    // longer than kMaxFrameBytes by its own header
  std::uint64_t bad_header = 0;  // header length that the format does not know
};

class NovatelStream {
 public:
  static constexpr std::size_t kMaxFrameBytes = 2'048;

  // Calls sink(const NovatelFrame&) for every frame that is complete after these bytes.
  template <class Sink>
  void feed(std::span<const std::uint8_t> bytes, Sink&& sink) {
    counters_.bytes += bytes.size();
    while (!bytes.empty()) {
      const std::size_t n = std::min(bytes.size(), buffer_.size() - size_);
      std::copy_n(bytes.begin(), n, buffer_.begin() + static_cast<std::ptrdiff_t>(size_));
      size_ += n;
      bytes = bytes.subspan(n);
      NovatelFrame frame;
      while (next(frame)) sink(static_cast<const NovatelFrame&>(frame));
      compact();
    }
  }

  const StreamCounters& counters() const { return counters_; }

 private:
  bool next(NovatelFrame& frame);
  void skip_to_sync();
  void discard(std::size_t n);
  void compact();

  std::array<std::uint8_t, 2 * kMaxFrameBytes> buffer_{};
  std::size_t begin_ = 0, size_ = 0;  // unread bytes are [begin_, size_)
  StreamCounters counters_;
};

}  // namespace pitwall::gnss

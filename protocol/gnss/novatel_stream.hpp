// Frame extractor for NovAtel byte streams with binary and ASCII frames mixed. A stream may start
// at any byte, contain other text, and be damaged.
//   in     bytes in pieces of any size
//   out    every frame with a correct CRC, once, in order, for any division into pieces. An ASCII
//          log is a frame only with its line end, so that no part of it is unchecked.
//   errors counters; a damaged frame loses only itself: the search resumes at the byte after its
//          sync
//   bound  frames longer than kMaxFrameBytes are counted and skipped; no allocation
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "protocol/gnss/novatel_codec.hpp"
#include "protocol/gnss/stream_window.hpp"

namespace pitwall::gnss {

class NovatelStream {
 public:
  static constexpr std::size_t kMaxFrameBytes = 2'048;

  // Calls sink(const NovatelFrame&) for every frame that is complete after these bytes.
  template <class Sink>
  void feed(std::span<const std::uint8_t> bytes, Sink&& sink) {
    counters_.bytes += bytes.size();
    window_.feed(bytes, [&] {
      NovatelFrame frame;
      while (next(frame)) sink(static_cast<const NovatelFrame&>(frame));
    });
  }

  const StreamCounters& counters() const { return counters_; }

 private:
  // Result of examining the front of the window.
  enum class Found { kFrame, kNothing, kNotYet };

  bool next(NovatelFrame& frame);
  Found binary(std::span<const std::uint8_t> unread, NovatelFrame& frame);
  Found ascii(std::span<const std::uint8_t> unread, NovatelFrame& frame);
  void skip_to_sync();
  void discard(std::size_t n);

  StreamWindow<kMaxFrameBytes> window_;
  StreamCounters counters_;
  bool out_of_sync_ = false;  // inside bytes that belong to no frame
};

}  // namespace pitwall::gnss

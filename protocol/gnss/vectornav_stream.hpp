// Frame extractor for VectorNav byte streams with binary messages. A stream may start at any byte,
// contain ASCII, and be damaged.
//   in     bytes in pieces of any size; the outputs that the sensor is configured to send
//   out    every message of one of these outputs with a correct CRC, once, in order, for any
//          division into pieces
//   errors counters; a damaged message loses only itself. A header of another output counts as
//          unexpected and begins no message: a CRC-16 alone accepts one in 65,536 false starts, the
//          comparison of the whole header none. Without outputs every valid header is accepted.
//   bound  no allocation
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>

#include "protocol/gnss/stream_window.hpp"
#include "protocol/gnss/vectornav_codec.hpp"
#include "protocol/vocabulary/fixed_vector.hpp"

namespace pitwall::gnss {

class VectorNavStream {
 public:
  static constexpr std::size_t kMaxOutputs = 3;  // binary outputs of a sensor

  explicit VectorNavStream(std::span<const VectorNavOutput> expected = {});

  // Calls sink(const VectorNavFrame&) for every message that is complete after these bytes.
  template <class Sink>
  void feed(std::span<const std::uint8_t> bytes, Sink&& sink) {
    counters_.bytes += bytes.size();
    window_.feed(bytes, [&] {
      VectorNavFrame frame;
      while (next(frame)) sink(static_cast<const VectorNavFrame&>(frame));
    });
  }

  const StreamCounters& counters() const { return counters_; }

 private:
  bool next(VectorNavFrame& frame);
  bool is_expected(const VectorNavOutput& output) const;
  void discard(std::size_t n);

  FixedVector<VectorNavOutput, kMaxOutputs> expected_;
  StreamWindow<kMaxVectorNavBytes> window_;
  StreamCounters counters_;
  bool out_of_sync_ = false;  // inside bytes that belong to no frame
};

}  // namespace pitwall::gnss

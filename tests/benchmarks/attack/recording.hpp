// Recording of a radio path: all datagrams in order, and the openings of key exchanges, each once.
//   in     copies of datagrams, oldest first
//   out    the newest openings; the capture, whole or up to the mark
//   errors none: after kMost datagrams or openings, new ones are not kept
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <set>
#include <span>
#include <vector>

#include "tests/benchmarks/attack/tap.hpp"

namespace pitwall::attack {

using Bytes = std::vector<std::uint8_t>;

struct Recorded {
  bool from_car = false;
  Bytes bytes;
};

class Recording {
 public:
  static constexpr std::size_t kMost = 1U << 16U;

  void add(const Copy& copy);
  void mark() { mark_ = capture_.size(); }

  std::span<const Recorded> capture() const { return capture_; }
  std::span<const Recorded> before_mark() const { return std::span(capture_).first(mark_); }
  // The newest openings, at most `count`.
  std::span<const Bytes> openings(std::size_t count) const;
  std::span<const Bytes> openings() const { return openings_; }

 private:
  std::vector<Recorded> capture_;
  std::vector<Bytes> openings_;
  std::set<Bytes> known_;
  std::size_t mark_ = 0;
};

}  // namespace pitwall::attack

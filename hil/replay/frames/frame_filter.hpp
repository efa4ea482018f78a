// Filter of the frames that a replay plays, by identifier.
//   in     identifiers that are wanted, identifiers that are not; frames in the order of the log
//   out    whether a frame is played; how many were left out
//   errors problem(): an identifier of the filter that no frame had, with those that there are
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "protocol/can/frame.hpp"
#include "protocol/vocabulary/result.hpp"

namespace pitwall::replay {

struct FrameFilterOptions {
  std::vector<std::uint32_t> ids{};      // only these; none: all
  std::vector<std::uint32_t> not_ids{};  // but these
};

class FrameFilter {
 public:
  static constexpr std::size_t kMostListed = 40;  // identifiers that an error names

  explicit FrameFilter(FrameFilterOptions options);

  bool takes(const can::Frame& frame);
  bool has_seen_any() const { return !seen_.empty(); }
  std::uint64_t left_out() const { return left_out_; }

  // Of the frames that takes() was asked about.
  std::optional<Problem> problem() const;

 private:
  bool is_wanted(std::uint32_t id) const;
  std::string known_ids() const;

  FrameFilterOptions options_;
  // Of each identifier that came: whether it is played.
  std::map<std::uint32_t, bool> seen_;
  std::uint64_t left_out_ = 0;
};

}  // namespace pitwall::replay

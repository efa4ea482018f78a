// SPDX-License-Identifier: Apache-2.0
#include "hil/replay/frames/frame_filter.hpp"

#include <algorithm>
#include <utility>

#include "protocol/vocabulary/text.hpp"

namespace pitwall::replay {
namespace {

bool holds(const std::vector<std::uint32_t>& ids, std::uint32_t id) {
  return std::ranges::find(ids, id) != ids.end();
}

}  // namespace

FrameFilter::FrameFilter(FrameFilterOptions options) : options_(std::move(options)) {}

bool FrameFilter::is_wanted(std::uint32_t id) const {
  return (options_.ids.empty() || holds(options_.ids, id)) && !holds(options_.not_ids, id);
}

bool FrameFilter::takes(const can::Frame& frame) {
  auto known = seen_.find(frame.id);
  if (known == seen_.end()) known = seen_.emplace(frame.id, is_wanted(frame.id)).first;
  if (!known->second) ++left_out_;
  return known->second;
}

std::string FrameFilter::known_ids() const {
  std::string text;
  std::size_t listed = 0;
  for (const auto& [id, wanted] : seen_) {
    if (listed == kMostListed) break;
    text += formatted("%s%X", listed++ == 0 ? "" : ", ", id);
  }
  if (seen_.size() > listed) text += " and " + std::to_string(seen_.size() - listed) + " more";
  return seen_.empty() ? "there are none" : text;
}

std::optional<Problem> FrameFilter::problem() const {
  const auto missing = [&](const std::vector<std::uint32_t>& ids,
                           const char* option) -> std::optional<Problem> {
    for (const std::uint32_t id : ids)
      if (!seen_.contains(id))
        return Problem{formatted("%s %X", option, id),
                       "no frame has this identifier; expected one of: " + known_ids()};
    return std::nullopt;
  };
  if (auto problem = missing(options_.ids, "--id")) return problem;
  return missing(options_.not_ids, "--not-id");
}

}  // namespace pitwall::replay

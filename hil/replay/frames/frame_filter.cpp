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

FrameFilter::FrameFilter(FrameFilterOptions options) : options_(std::move(options)) {
  for (const SendingNode& node : options_.nodes)
    if (node.is_left_out) of_other_nodes_.insert(node.messages.begin(), node.messages.end());
}

bool FrameFilter::is_wanted(MessageId message) const {
  return (options_.ids.empty() || holds(options_.ids, message.id)) &&
         !holds(options_.not_ids, message.id) && !of_other_nodes_.contains(message);
}

bool FrameFilter::takes(const can::Frame& frame) {
  const MessageId message{.id = frame.id, .extended = frame.extended};
  auto known = seen_.find(message);
  if (known == seen_.end()) known = seen_.emplace(message, is_wanted(message)).first;
  if (!known->second) ++left_out_;
  return known->second;
}

bool FrameFilter::has_seen(std::uint32_t id) const {
  return seen_.contains({id, false}) || seen_.contains({id, true});
}

bool FrameFilter::has_seen(const SendingNode& node) const {
  return std::ranges::any_of(node.messages, [&](MessageId m) { return seen_.contains(m); });
}

std::string FrameFilter::known_ids() const {
  std::string text;
  std::size_t listed = 0;
  for (const auto& [message, wanted] : seen_) {
    if (listed == kMostListed) break;
    text += formatted("%s%X", listed++ == 0 ? "" : ", ", message.id);
  }
  if (seen_.size() > listed) text += " and " + std::to_string(seen_.size() - listed) + " more";
  return seen_.empty() ? "there are none" : text;
}

std::optional<Problem> FrameFilter::node_problem() const {
  std::string known;
  for (const SendingNode& node : options_.nodes)
    if (has_seen(node)) known += (known.empty() ? "" : ", ") + node.name;
  if (known.empty()) known = "there are none";
  for (const SendingNode& node : options_.nodes)
    if (node.is_left_out && !has_seen(node))
      return Problem{"--overlay " + node.name,
                     "this node sent none of the frames; expected one of: " + known};
  return std::nullopt;
}

std::optional<Problem> FrameFilter::problem() const {
  const auto missing = [&](const std::vector<std::uint32_t>& ids,
                           const char* option) -> std::optional<Problem> {
    for (const std::uint32_t id : ids)
      if (!has_seen(id))
        return Problem{formatted("%s %X", option, id),
                       "no frame has this identifier; expected one of: " + known_ids()};
    return std::nullopt;
  };
  if (auto problem = missing(options_.ids, "--id")) return problem;
  if (auto problem = missing(options_.not_ids, "--not-id")) return problem;
  return node_problem();
}

}  // namespace pitwall::replay

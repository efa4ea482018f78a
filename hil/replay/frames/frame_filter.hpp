// Filter of the frames of a replay, by identifier and by sending node.
//   in     wanted identifiers, unwanted identifiers and nodes; frames in the order of the log
//   out    whether a frame is played; how many were left out
//   errors problem(): an identifier of the filter that no frame had, or an unwanted node that sent
//          no frame, with the list of those that occur
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <compare>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "protocol/can/frame.hpp"
#include "protocol/vocabulary/result.hpp"

namespace pitwall::replay {

struct MessageId {
  std::uint32_t id = 0;
  bool extended = false;

  auto operator<=>(const MessageId&) const = default;
};

// A node of a database and the messages it sends.
struct SendingNode {
  std::string name;
  std::vector<MessageId> messages{};
  bool is_left_out = false;
};

struct FrameFilterOptions {
  std::vector<std::uint32_t> ids{};      // only these; empty: all
  std::vector<std::uint32_t> not_ids{};  // all except these
  std::vector<SendingNode> nodes{};      // all nodes of the database
};

class FrameFilter {
 public:
  static constexpr std::size_t kMostListed = 40;  // largest number of identifiers in an error

  explicit FrameFilter(FrameFilterOptions options);

  bool takes(const can::Frame& frame);
  bool has_seen_any() const { return !seen_.empty(); }
  std::uint64_t left_out() const { return left_out_; }

  // Concerns the frames given to takes().
  std::optional<Problem> problem() const;

 private:
  bool is_wanted(MessageId id) const;
  bool has_seen(std::uint32_t id) const;
  bool has_seen(const SendingNode& node) const;
  std::string known_ids() const;
  std::optional<Problem> node_problem() const;

  FrameFilterOptions options_;
  std::set<MessageId> of_other_nodes_;  // messages of the nodes that are left out
  // For each identifier that occurred: whether it is played.
  std::map<MessageId, bool> seen_;
  std::uint64_t left_out_ = 0;
};

}  // namespace pitwall::replay

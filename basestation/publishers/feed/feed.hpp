// Queue from the event loop to a publisher with its own thread: states of the car, messages of the
// service.
//   in     samples, texts and status of the base, from the loop
//   out    all items that wait, for the thread
//   invariants
//          neither side waits for the other: the lock is held only for a copy or a move. Items stay
//          in order; beyond the bounds the oldest item is dropped and counted for each of its
//          channels, so that a slow publisher has the newest items and a count of its losses
//   bound  kItems, and kTextBytes of texts
//   errors drops(), by the channels of protocol/recorder/channels.hpp, and kStatusChannel
//   cost   sample(): one copy of the state, one allocation; a system call when the thread sleeps
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "basestation/publishers/ros_view/diagnostics.hpp"
#include "protocol/recorder/channels.hpp"
#include "protocol/telemetry/registry/registry.hpp"
#include "protocol/transport/posix_call.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::publishers::feed {

struct Sample {
  telemetry::Snapshot state{};
  telemetry::GroupSet groups{};  // newer than in the sample before
  Instant received{};
};
struct Reported {
  recorder::Topic topic{};
  Instant at{};
  std::string json;
};
using ros_view::BaseStatus;
using Item =
    std::variant<std::unique_ptr<const Sample>, Reported, std::unique_ptr<const BaseStatus>>;

inline constexpr std::size_t kStatusChannel = telemetry::kGroups + recorder::kTopics;
inline constexpr std::size_t kFeedChannels = kStatusChannel + 1;
std::vector<std::string> channel_names();  // all, in order
using ChannelCounts = std::array<std::uint64_t, kFeedChannels>;

class Feed {
 public:
  static constexpr std::size_t kItems = 256;  // about five seconds
  static constexpr std::size_t kTextBytes = 4 * 1'024 * 1'024;

  Feed();

  void sample(const telemetry::Snapshot& state, telemetry::GroupSet groups, Instant received);
  void text(recorder::Topic topic, Instant at, std::string_view json);
  void base_status(std::unique_ptr<const BaseStatus> base_status);
  void close();  // asks the thread to end

  int fd() const { return wake_fd_.get(); }  // readable while items wait, or once it is closed
  std::vector<Item> take();
  bool closed() const;
  ChannelCounts drops() const;

 private:
  void push(Item item);
  void drop_oldest();
  void wake() const;

  transport::FileDescriptor wake_fd_;
  mutable std::mutex lock_;
  std::deque<Item> waiting_;  // from here on under the lock
  std::size_t text_bytes_ = 0;
  ChannelCounts drops_{};
  bool closed_ = false;
};

}  // namespace pitwall::publishers::feed

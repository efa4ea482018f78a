// Channels for Foxglove clients, and the source of each channel's messages.
//   /vehicle/odom, /tf, /imu, /gnss/*, /diagnostics ...   the standard messages of ROS 2, from
//                      publishers/ros_view
//   /car/GROUP         every group of the registry, and
//   /base/TYPE         the texts that consoles get; both as in a recording, so that one layout fits
//                      a live car and its recording
//   /base/values/GROUP values of the base itself: link, derived values
//   invariants
//          the time of a message is when the base received it; its header has the sampling time
//   cost   some tens of microseconds for a state with all groups
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "basestation/publishers/feed/feed.hpp"
#include "basestation/publishers/foxglove/protocol.hpp"
#include "basestation/publishers/ros_view/view.hpp"
#include "protocol/recorder/channels.hpp"

namespace pitwall::publishers::foxglove {

class Sources {
 public:
  using Sink =
      std::function<void(std::size_t channel, UtcTime at, std::span<const std::uint8_t> body)>;

  Sources(ros_view::ViewConfig view, recorder::ClockMap clock);

  const std::vector<ChannelRow>& channels() const { return channels_; }
  void statics(Instant now, const Sink& sink);
  void take(const feed::Sample& sample, const Sink& sink);
  void take(const feed::Reported& reported, const Sink& sink) const;
  void take(const feed::BaseStatus& base_status, const Sink& sink);
  UtcTime utc(Instant at) const { return UtcTime{clock_.to_file(at).ns}; }

 private:
  void add_view_topics(const std::string& space);
  void add_recorded_channels(const std::string& space);

  recorder::ClockMap clock_;
  ros_view::View view_;
  std::vector<ChannelRow> channels_;
  // Channel of each topic of the view and of each channel of a recording; npos if it has none.
  std::vector<std::size_t> of_view_, of_recording_;
};

}  // namespace pitwall::publishers::foxglove

// Markers of the opponents that the car tracks, for RViz and Foxglove.
//   in     the state as received by radio; the reference line of the track, for the places
//   out    for each opponent a box, an arrow as long as its way in a second, a flat disk of kSigmas
//          standard deviations around its place, a text. The box is translucent where the tracker
//          only carries the opponent on; then the text says when it was seen
//   invariants
//          each opponent has the same namespaces and ids in all messages; what is not known of it,
//          or too old, is deleted
//   frames of the map; heading and velocity are along the track
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "basestation/publishers/ros_view/car_messages.hpp"
#include "protocol/ros/messages/visualization.hpp"

namespace pitwall::publishers::ros_view {

inline constexpr std::size_t kOpponents = 4;
inline constexpr std::size_t kMarkersEach = 4;
inline constexpr double kSigmas = 2.0;
// Without a detection for longer, an opponent is only carried on.
inline constexpr double kCoastsAfter_s = 0.5;

ros::MarkerArray opponent_markers(const CarMessages& messages, const telemetry::Snapshot& state,
                                  const state::Course& course, Instant now);

}  // namespace pitwall::publishers::ros_view

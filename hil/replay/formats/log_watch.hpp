// Callbacks of a caller during the reading of a log: progress, and delivery of the frames in
// blocks, so that memory does not grow with the file.
//   in     functions; an empty one is not called
//   out    reached(): at intervals, bytes read so far and size of the file; take(): frames in
//          order, which are then removed from the CanLog. The remaining frames at the end stay in
//          the CanLog
//   errors max_frames or more in one CanLog: the log is refused, with advice
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <span>

namespace pitwall::replay {

struct LoggedFrame;

// About 6 GB; an hour of six saturated buses of 1 Mbit/s.
inline constexpr std::size_t kMaxLoggedFrames = 60'000'000;
inline constexpr std::size_t kFramesOfBlock = std::size_t{1} << 15U;
inline constexpr std::size_t kBytesBetweenReports = std::size_t{1} << 22U;

using ReadProgress = std::function<void(std::size_t done, std::size_t all)>;

struct LogWatch {
  ReadProgress reached{};
  std::function<void(std::span<const LoggedFrame> frames)> take{};
  std::size_t max_frames = kMaxLoggedFrames;
};

}  // namespace pitwall::replay

// What a caller may want while a log is read: to see how far it is, and to take the frames in
// blocks so that memory does not grow with the file.
//   in     functions; an empty one is not called
//   out    reached(): bytes of the file that have been read, and all of them, now and then;
//          take(): frames in their order, which are not in the CanLog any more. What is left at the
//          end stays in the CanLog
//   errors more than max_frames in one CanLog: the log is refused, with what to do
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <span>

namespace pitwall::replay {

struct LoggedFrame;

// Some 6 GB; an hour of six saturated buses of 1 Mbit/s.
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

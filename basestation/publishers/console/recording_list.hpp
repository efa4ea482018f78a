// List of the recordings in a folder.
//   in     a folder that holds recordings, or is one
//   out    for each, newest first: whose it is, when its segments begin, how large it is; the
//          document /api/recordings of PROTOCOL.md
//   invariants
//          nothing is written, and no segment is read but the head of the first: a glance, whatever
//          their size. Links are not followed
//   bound  kRecordingsMax, of kSegmentsMax segments each; older recordings are counted
//   errors a folder that cannot be read, or whose first segment is none of a base, says so in its
//          line; the others are listed
//   cost   some microseconds a segment: RecordingList looks on a thread of its own, again and again
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "protocol/vocabulary/time.hpp"

namespace pitwall::publishers::console {

inline constexpr std::string_view kRecordingsPath = "/api/recordings";
inline constexpr std::size_t kRecordingsMax = 200, kSegmentsMax = 5'000;

struct Recording {
  std::string name{}, folder{};
  std::string car{}, car_name{};  // as the first segment has them
  std::size_t segments = 0;
  std::uint64_t bytes = 0;
  std::optional<UtcTime> first{}, last{};  // when the first and the last segment begin
  bool running = false;                    // somebody writes it
  std::string problem{};                   // why it cannot be played
};

struct Recordings {
  std::string root;
  std::vector<Recording> found;
  std::size_t left_out = 0;
  std::string problem;  // why the folder cannot be read
};

Recordings recordings_of(const std::string& folder);
// `track`: of the base, for the command that plays one; may be empty.
std::string recordings_text(const Recordings& recordings, std::string_view track);

// When the segment of this name begins: NAME_20261122T003000.250Z_00012.mcap.
std::optional<UtcTime> begin_of_segment(std::string_view name);
// What plays it, typed in a shell.
std::string replay_command(std::string_view folder, std::string_view track);

class RecordingList {
 public:
  static constexpr Duration kEvery = seconds(10);
  using Show = std::function<void(std::string)>;  // on the list's own thread

  RecordingList(std::string folder, std::string track, Show show);
  ~RecordingList();
  RecordingList(const RecordingList&) = delete;
  RecordingList& operator=(const RecordingList&) = delete;

 private:
  void look_again_and_again();

  std::string folder_, track_;
  Show show_;
  std::mutex mutex_;
  std::condition_variable ending_;
  bool ends_ = false;
  std::thread thread_;
};

}  // namespace pitwall::publishers::console

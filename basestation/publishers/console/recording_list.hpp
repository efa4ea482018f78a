// List of the recordings in a folder.
//   in     a folder that holds recordings, or is one
//   out    for each, newest first: its car, when its segments begin, its size; the document
//          /api/recordings of PROTOCOL.md
//   invariants
//          nothing is written, and of the segments only the head of the first one is read, so that
//          the cost does not depend on their size. Links are not followed
//   bound  kRecordingsMax, of kSegmentsMax segments each; older recordings are counted
//   errors a recording whose folder cannot be read, or whose first segment is not one of a base,
//          has the problem in its line; the others are listed
//   cost   some microseconds a segment; RecordingList reads the folder on its own thread, each
//          kEvery
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
  std::string car{}, car_name{};  // as in the first segment
  std::size_t segments = 0;
  std::uint64_t bytes = 0;
  std::optional<UtcTime> first{}, last{};  // when the first and the last segment begin
  bool running = false;                    // a recorder is writing it
  std::string problem{};                   // why it cannot be played
};

struct Recordings {
  std::string root;
  std::vector<Recording> found;
  std::size_t left_out = 0;
  std::string problem;  // why the folder cannot be read
};

Recordings recordings_of(const std::string& folder);
// `track`: the track file for the replay command; may be empty.
std::string recordings_text(const Recordings& recordings, std::string_view track);

// Begin time in the name of a segment: NAME_20261122T003000.250Z_00012.mcap.
std::optional<UtcTime> begin_of_segment(std::string_view name);
// Shell command that replays the recording.
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
  void refresh_periodically();

  std::string folder_, track_;
  Show show_;
  std::mutex mutex_;
  std::condition_variable ending_;
  bool ends_ = false;
  std::thread thread_;
};

}  // namespace pitwall::publishers::console

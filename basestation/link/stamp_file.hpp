// File of the newest stamp that the car's openings had: a base station that is started again knows
// by it which openings of the key exchange are replays (protocol/telemetry/session/stamp.hpp).
//   in     path; keys of another base are another file. The newest stamp, as often as one likes
//   out    the stamp for AssociationConfig::newest_stamp; one line "stamp: NANOSECONDS", for its
//          owner only
//   units  nanoseconds since 1970-01-01 UTC by the car's clock, below 2^63
//   invariants
//          keep() waits for no disk: a thread writes, at most once a period and at the end; who
//          reads has the file of before or the new one, whole
//   errors read_stamp(): Problem with the line or the path. A base without this memory is harmless:
//          the stamps of its car are newer, and replays reach as far as a pending session
//          a write that fails: take_problem(), once; later stamps are tried again
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <thread>

#include "protocol/telemetry/session/stamp.hpp"
#include "protocol/vocabulary/result.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::link {

// keys/base.keys: keys/base.stamp
std::string stamp_file_of(const std::string& key_file);

// 0: there is no such file.
Result<telemetry::Stamp, Problem> read_stamp(const std::string& path);
Result<telemetry::Stamp, Problem> parse_stamp(std::string_view text, const std::string& path);
std::string stamp_text(telemetry::Stamp stamp);

class StampFile {
 public:
  static constexpr Duration kPeriod = seconds(1);

  // `known`: what the file has.
  StampFile(std::string path, telemetry::Stamp known, Duration period = kPeriod);
  ~StampFile();
  StampFile(const StampFile&) = delete;
  StampFile& operator=(const StampFile&) = delete;

  void keep(telemetry::Stamp newest);
  std::optional<Problem> take_problem();

 private:
  void write_all();

  std::string path_;
  Duration period_;
  telemetry::Stamp reported_;  // of keep() only
  std::mutex mutex_;
  std::condition_variable changed_;
  telemetry::Stamp newest_, tried_;
  std::optional<Problem> problem_;
  bool failed_ = false, ended_ = false;
  std::thread writer_;
};

}  // namespace pitwall::link

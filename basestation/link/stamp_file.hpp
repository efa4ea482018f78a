// File of the newest stamp in the car's key-exchange openings. With it a restarted base station
// recognizes openings that are replays (protocol/telemetry/session/stamp.hpp).
//   in     path, a different one for other keys of the base; the newest stamp, at any rate
//   out    the stamp for AssociationConfig::newest_stamp; a file of one line "stamp: NANOSECONDS",
//          readable by its owner only
//   units  nanoseconds since 1970-01-01 UTC by the car's clock, below 2^63
//   invariants
//          keep() does not wait for the disk: a thread writes, at most once a period and at the
//          end; a reader gets the old file or the new one, never a part
//   errors read_stamp(): Problem with the line or the path. A base without the file stays safe: its
//          car sends newer stamps, and a replay gets no further than a pending session
//          take_problem(): the first failed write, once; later stamps are written again
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

// Path of the stamp file beside a key file: keys/base.stamp for keys/base.keys.
std::string stamp_file_of(const std::string& key_file);

// Returns 0 if there is no such file.
Result<telemetry::Stamp, Problem> read_stamp(const std::string& path);
Result<telemetry::Stamp, Problem> parse_stamp(std::string_view text, const std::string& path);
std::string stamp_text(telemetry::Stamp stamp);

class StampFile {
 public:
  static constexpr Duration kPeriod = seconds(1);

  // `known`: the stamp in the file.
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
  telemetry::Stamp reported_;  // used by keep() only
  std::mutex mutex_;
  std::condition_variable changed_;
  telemetry::Stamp newest_, tried_;
  std::optional<Problem> problem_;
  bool failed_ = false, ended_ = false;
  std::thread writer_;
};

}  // namespace pitwall::link

// SPDX-License-Identifier: Apache-2.0
#include "hil/replay/recordings/recording_reader.hpp"

#include <algorithm>

#include "hil/replay/recordings/decompression.hpp"
#include "hil/replay/recordings/lcm_recording.hpp"
#include "hil/replay/recordings/mcap_recording.hpp"
#include "hil/replay/recordings/receiver_stream.hpp"
#include "hil/replay/recordings/sqlite_bag.hpp"
#include "protocol/recording/lcm_log.hpp"
#include "protocol/recording/mcap_wire.hpp"

namespace pitwall::traffic {
namespace {

bool begins_with(Bytes file, Bytes magic) {
  return file.size() >= magic.size() && std::ranges::equal(file.first(magic.size()), magic);
}

}  // namespace

std::string_view to_string(RecordingFormat format) {
  switch (format) {
    case RecordingFormat::kMcap:
      return "MCAP";
    case RecordingFormat::kSqliteBag:
      return "ROS 2 bag in SQLite";
    case RecordingFormat::kLcm:
      return "LCM event log";
    case RecordingFormat::kReceiver:
      return "byte stream of a receiver";
    case RecordingFormat::kNone:
      break;
  }
  return "no recording";
}

RecordingFormat format_of(Bytes file) {
  if (begins_with(file, recording::kMcapMagic)) return RecordingFormat::kMcap;
  if (is_sqlite(file)) return RecordingFormat::kSqliteBag;
  const Bytes probe = file.first(std::min(file.size(), kReceiverProbeBytes));
  if (recording::LcmLogReader{probe}.next()) return RecordingFormat::kLcm;
  return receiver_of(probe) == Receiver::kUnknown ? RecordingFormat::kNone
                                                  : RecordingFormat::kReceiver;
}

Result<Recording, Problem> read_recording(transport::FileBytes file, const std::string& name,
                                          const replay::ReadProgress& reached) {
  if (is_zstd(file.bytes())) {
    auto plain = decompress_zstd(file.bytes());
    if (!plain) return refuse(name, plain.error());
    file = transport::FileBytes(*std::move(plain));
  }
  switch (format_of(file.bytes())) {
    case RecordingFormat::kMcap:
      return read_mcap(file, name, reached);
    case RecordingFormat::kSqliteBag:
      return read_sqlite_bag(std::move(file), name);
    case RecordingFormat::kLcm:
      return read_lcm(file, name, reached);
    case RecordingFormat::kReceiver:
      return read_receiver_stream(file, name);
    case RecordingFormat::kNone:
      break;
  }
  return refuse(name,
                "is not a recording: expected MCAP, a bag of ROS 2 (.mcap, .db3), "
                "an event log of LCM, or the bytes of a NovAtel or VectorNav receiver");
}

}  // namespace pitwall::traffic

// SPDX-License-Identifier: Apache-2.0
#include "hil/replay/recordings/can_part.hpp"

#include <optional>
#include <utility>
#include <vector>

#include "hil/replay/formats/log_reader.hpp"
#include "hil/replay/formats/recognise.hpp"
#include "hil/replay/recordings/decompression.hpp"
#include "hil/replay/recordings/recording_reader.hpp"
#include "protocol/recorder/can_record.hpp"
#include "protocol/vocabulary/bytes.hpp"

namespace pitwall::traffic {
namespace {

using replay::CanLog;
using replay::LoggedDirection;

LoggedDirection direction_of(const std::string& source) {
  if (source == recorder::kReceivedTopic) return LoggedDirection::kReceived;
  if (source == recorder::kSentTopic) return LoggedDirection::kTransmitted;
  return LoggedDirection::kUnknown;
}

// The channel of each source; none: its records are no CAN frames.
using Channels = std::vector<std::optional<std::uint8_t>>;
Channels named_channels(const Recording& recording, CanLog& log) {
  Channels channels(recording.sources.size());
  for (std::size_t i = 0; i < recording.sources.size(); ++i) {
    const Source& source = recording.sources[i];
    if (source.kind != SourceKind::kCan || source.records == 0) continue;
    const std::size_t number = log.channels.size();
    channels[i] = static_cast<std::uint8_t>(number);
    const bool fits = source.name.size() <= replay::kMaxChannelName;
    log.channels.push_back(fits ? source.name : "can" + std::to_string(number));
    if (!fits) log.notes.push_back(log.channels.back() + " is " + source.name);
  }
  return channels;
}

void keep_what_was_reported(const Recording& recording, CanLog& log) {
  const RecordingCounters& c = recording.counters;
  log.counters.bad_records = c.refused + c.lost_blocks;
  log.counters.error_frames = c.error_frames;
  for (const Remark& remark : recording.remarks) {
    if (log.remarks.size() == replay::kListedRemarks) {
      ++log.remarks_left_off;
      continue;
    }
    log.remarks.push_back({remark.place, remark.what});
  }
}

}  // namespace

Result<CanLog, Problem> can_part(const Recording& recording, const std::string& format,
                                 const std::string& name) {
  CanLog log;
  log.format = format;
  const Channels channels = named_channels(recording, log);
  if (log.channels.empty()) return Unexpected{Problem{name, "holds no CAN frames"}};
  if (log.channels.size() > replay::kMaxChannels)
    return Unexpected{Problem{
        name, "more than " + std::to_string(replay::kMaxChannels) + " sources of CAN frames"}};
  keep_what_was_reported(recording, log);
  UtcTime before{};
  for (const Record& record : recording.records) {
    const can::Frame* const frame = record.frame();
    if (frame == nullptr) {
      ++log.counters.other_records;
      continue;
    }
    log.counters.backward_stamps += !log.frames.empty() && record.at < before;
    before = record.at;
    log.frames.push_back({.at = record.at,
                          .frame = *frame,
                          .channel = *channels[record.source],
                          .fd_flags = 0,
                          .direction = direction_of(recording.sources[record.source].name)});
  }
  return log;
}

bool is_recording(std::string_view file) {
  using replay::FileFormat;
  if (replay::recognise(file) <= FileFormat::kGzip) return false;
  return is_zstd(as_bytes(file)) || format_of(as_bytes(file)) != RecordingFormat::kNone;
}

Result<CanLog, Problem> read_can_traffic(transport::FileBytes file, const std::string& name,
                                         const replay::LogWatch& watch) {
  if (!is_recording(file.text())) return replay::read_can_log(file.text(), name, watch);
  const std::string format{to_string(format_of(file.bytes()))};
  const auto recording = read_recording(std::move(file), name, watch.reached);
  if (!recording) return Unexpected{recording.error()};
  return can_part(*recording, format, name);
}

}  // namespace pitwall::traffic

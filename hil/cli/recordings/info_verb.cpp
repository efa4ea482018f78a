// SPDX-License-Identifier: Apache-2.0
#include "hil/cli/recordings/info_verb.hpp"

#include <cstdio>
#include <string>
#include <utility>

#include "hil/cli/command_line.hpp"
#include "hil/cli/exit_code.hpp"
#include "hil/replay/formats/log_reader.hpp"
#include "hil/replay/log_summary.hpp"
#include "hil/replay/reading/progress_line.hpp"
#include "hil/replay/recordings/can_part.hpp"
#include "hil/replay/recordings/recording_reader.hpp"
#include "hil/replay/recordings/recording_summary.hpp"
#include "protocol/transport/file.hpp"
#include "protocol/transport/file_bytes.hpp"

namespace pitwall::cli {
namespace {

// What is shown of a file, and whether all of it was read.
struct FileInfo {
  std::string text, remarks, json;
  bool is_whole = true;
};

// In blocks: memory does not grow with the log.
Result<FileInfo, Problem> info_of_log(std::string_view bytes, const std::string& file,
                                      const replay::ReadProgress& reached) {
  replay::LogSummaryBuilder builder;
  const auto take = [&](std::span<const replay::LoggedFrame> frames) { builder.add(frames); };
  const auto log = replay::read_can_log(bytes, file, {.reached = reached, .take = take});
  if (!log) return Unexpected{log.error()};
  builder.add(log->frames);
  const replay::LogSummary summary = std::move(builder).finish(log->channels.size());
  return FileInfo{.text = replay::to_text(summary, *log, file),
                  .remarks = replay::to_text(*log, file),
                  .json = replay::to_json(summary, *log, file),
                  .is_whole = log->counters.bad_records + log->counters.cut_tails == 0};
}

Result<FileInfo, Problem> info_of_recording(const transport::FileBytes& bytes,
                                            const std::string& file,
                                            const replay::ReadProgress& reached) {
  const std::string format{to_string(traffic::format_of(bytes.bytes()))};
  const auto recording = traffic::read_recording(bytes, file, reached);
  if (!recording) return Unexpected{recording.error()};
  const traffic::RecordingSummary summary = traffic::summary_of(*recording);
  const traffic::RecordingCounters& c = recording->counters;
  return FileInfo{.text = traffic::to_text(summary, *recording, format, file),
                  .remarks = traffic::remarks_of(*recording),
                  .json = traffic::to_json(summary, *recording, format, file) + "\n",
                  .is_whole = c.refused + c.lost_blocks + c.lost_bytes == 0};
}

Result<FileInfo, Problem> info_of(const std::string& file, bool progress) {
  const auto bytes = transport::FileBytes::map(file);
  if (!bytes) return Unexpected{bytes.error()};
  replay::ProgressLine line("reading " + file, progress);
  return traffic::is_recording(bytes->text()) ? info_of_recording(*bytes, file, line.function())
                                              : info_of_log(bytes->text(), file, line.function());
}

}  // namespace

int info_verb(std::span<const std::string> args) {
  std::string file, json_file;
  bool strict = false, progress = false;
  CommandLine app{
      "pitwall-hil info: what a log or a recording holds. CAN logs: candump, Vector ASC and BLF, "
      "PEAK TRC, SocketCAN pcap and pcapng, also with gzip. Recordings: MCAP (the car's, the "
      "base's, bags of ROS 2), .db3 bags, LCM event logs, bytes of NovAtel and VectorNav "
      "receivers. Exit 0 readable, 1 records were left out with --strict, 2 none of these"};
  app.option("FILE", file, "a file of any of these formats, known by its content").required();
  app.option("--json", json_file, "write all of it here");
  app.flag("--strict", strict, "a record that does not read is a failure");
  app.flag("--progress", progress, replay::kProgressHelp);
  if (const auto code = app.ended_by(args)) return *code;
  const auto info = info_of(file, progress);
  if (!info) return refuse(info.error());
  std::printf("%s", info->text.c_str());
  std::fflush(stdout);
  std::fprintf(stderr, "%s", info->remarks.c_str());
  if (!json_file.empty()) {
    const auto written = transport::write_file(json_file, info->json);
    if (!written) return refuse(written.error());
  }
  return strict && !info->is_whole ? kExitFailed : kExitPass;
}

}  // namespace pitwall::cli

// SPDX-License-Identifier: Apache-2.0
#include "hil/cli/recordings/info_verb.hpp"

#include <cstdio>

#include "hil/cli/command_line.hpp"
#include "hil/cli/exit_code.hpp"
#include "hil/replay/formats/log_reader.hpp"
#include "hil/replay/log_summary.hpp"
#include "protocol/transport/file.hpp"

namespace pitwall::cli {

int info_verb(std::span<const std::string> args) {
  std::string file, json_file;
  bool strict = false;
  CommandLine app{
      "pitwall-hil info: what a CAN log holds; candump, Vector ASC and BLF, PEAK TRC, SocketCAN "
      "pcap and pcapng, also with gzip. Exit 0 readable, 1 records were left out with --strict, "
      "2 no CAN log"};
  app.option("FILE", file, "CAN log of any of these formats, known by its content").required();
  app.option("--json", json_file, "write all of it here");
  app.flag("--strict", strict, "a record that does not read is a failure");
  if (const auto code = app.ended_by(args)) return *code;
  const auto bytes = transport::read_file(file);
  if (!bytes) return refuse(bytes.error());
  const auto log = replay::read_can_log(*bytes, file);
  if (!log) return refuse(log.error());
  const replay::LogSummary summary = replay::summary_of(*log);
  std::printf("%s", replay::to_text(summary, *log, file).c_str());
  std::fflush(stdout);
  std::fprintf(stderr, "%s", replay::to_text(*log, file).c_str());
  if (!json_file.empty()) {
    const auto written = transport::write_file(json_file, replay::to_json(summary, *log, file));
    if (!written) return refuse(written.error());
  }
  const bool is_whole = log->counters.bad_records + log->counters.cut_tails == 0;
  return strict && !is_whole ? kExitFailed : kExitPass;
}

}  // namespace pitwall::cli

// SPDX-License-Identifier: Apache-2.0
#include "hil/cli/recordings/convert_verb.hpp"

#include <cstdio>

#include "hil/cli/command_line.hpp"
#include "hil/cli/exit_code.hpp"
#include "hil/replay/reading/can_file.hpp"
#include "hil/replay/reading/progress_line.hpp"
#include "hil/replay/writers/log_writer.hpp"
#include "protocol/transport/file.hpp"

namespace pitwall::cli {

int convert_verb(std::span<const std::string> args) {
  std::string in, out;
  bool strict = false, progress = false;
  CommandLine app{
      "pitwall-hil convert: the CAN frames of a log or a recording as a file of another format. "
      "Exit 0 written, 1 something was "
      "left out or is not kept with --strict, 2 no CAN log or not written"};
  app.option("IN", in, "log or recording of any format that info reads, known by its content")
      .required();
  app.option("OUT", out,
             "new file; its name says the format: " + std::string(replay::kWrittenSuffixes))
      .required();
  app.flag("--strict", strict, "a record or a property that is not kept is a failure");
  app.flag("--progress", progress, replay::kProgressHelp);
  if (const auto code = app.ended_by(args)) return *code;
  const auto log = replay::read_can_file(in, progress);
  if (!log) return refuse(log.error());
  const auto written = replay::write_can_log(*log, out);
  if (!written) return refuse(written.error());
  if (const auto done = transport::write_file(out, written->bytes); !done)
    return refuse(done.error());
  std::fprintf(stderr, "%s", replay::to_text(*log, in).c_str());
  for (const std::string& loss : written->losses)
    std::fprintf(stderr, "%s: warning: %s\n", out.c_str(), loss.c_str());
  std::printf("%s: %zu frames of %s\n", out.c_str(), log->frames.size(), log->format.c_str());
  const bool is_whole =
      written->losses.empty() && log->counters.bad_records + log->counters.cut_tails == 0;
  return strict && !is_whole ? kExitFailed : kExitPass;
}

}  // namespace pitwall::cli

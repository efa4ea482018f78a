// SPDX-License-Identifier: Apache-2.0
#include "hil/cli/recordings/rival_verb.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>
#include <vector>

#include "hil/bench/recorded/drive_again.hpp"
#include "hil/bench/recorded/rival.hpp"
#include "hil/cli/command_line.hpp"
#include "hil/cli/exit_code.hpp"
#include "hil/cli/recordings/recording_folder.hpp"
#include "hil/replay/recordings/merge.hpp"
#include "protocol/transport/file.hpp"
#include "protocol/vocabulary/text.hpp"

namespace pitwall::cli {
namespace {

using bench::RivalRow;

constexpr std::size_t kSteps = 10;  // of the table

struct RivalOptions {
  std::string own, other, out_file;
  double offset_s = 0.0;
  bench::RunFiles files;
};

double seconds_since(const RivalRow& row, const RivalRow& first) {
  return Duration{row.at.ns - first.at.ns}.seconds();
}

std::string csv_of(const std::vector<RivalRow>& rows) {
  std::string text = "t_s,utc_ns,own_s_m,own_n_m,own_mps,rival_s_m,rival_n_m,gap_m,gap_s\n";
  for (const RivalRow& row : rows)
    text +=
        formatted("%.3f,%lld,%.3f,%.3f,%.3f,%.3f,%.3f,%.3f,%.3f\n",
                  seconds_since(row, rows.front()), static_cast<long long>(row.at.ns), row.own.s_m,
                  row.own.n_m, row.own_mps, row.rival.s_m, row.rival.n_m, row.gap_m, row.gap_s);
  return text;
}

// Ten moments of the run, and the closest one.
std::string summary_of(const std::vector<RivalRow>& rows) {
  std::string text = "      t s   own s m  rival s m  rival n m    gap m    gap s\n";
  const auto line = [&](const RivalRow& row) {
    text += formatted("%9.1f %9.1f  %9.1f  %9.2f %8.1f %8.2f\n", seconds_since(row, rows.front()),
                      row.own.s_m, row.rival.s_m, row.rival.n_m, row.gap_m, row.gap_s);
  };
  for (std::size_t i = 0; i < kSteps; ++i) line(rows[i * (rows.size() - 1) / (kSteps - 1)]);
  const auto closest =
      std::ranges::min_element(rows, {}, [](const RivalRow& row) { return std::abs(row.gap_m); });
  const auto ahead =
      std::ranges::count_if(rows, [](const RivalRow& row) { return row.gap_m > 0.0; });
  return text + formatted(
                    "%zu positions of both; the rival is ahead in %.0f %% of them; closest "
                    "%.1f m at %.1f s\n",
                    rows.size(),
                    100.0 * static_cast<double>(ahead) / static_cast<double>(rows.size()),
                    closest->gap_m, seconds_since(*closest, rows.front()));
}

Result<bench::RivalRows, Problem> rows_of(const RivalOptions& options) {
  const auto run = bench::RecordedRun::open(options.own);
  if (!run) return Unexpected{run.error()};
  std::vector<std::string> remarks;
  const auto setup = bench::setup_of(*run, options.files, remarks);
  if (!setup) return Unexpected{setup.error()};
  auto own = read_traffic(options.own);
  if (!own) return Unexpected{own.error()};
  auto other = read_traffic(options.other);
  if (!other) return Unexpected{other.error()};
  std::vector<traffic::MergeInput> inputs;
  inputs.push_back({.recording = *std::move(own), .label = bench::kOwnLabel});
  inputs.push_back({.recording = *std::move(other),
                    .label = bench::kRivalLabel,
                    .offset = from_seconds(options.offset_s)});
  const auto both = traffic::merge(std::move(inputs));
  if (!both) return Unexpected{both.error()};
  for (const std::string& remark : remarks) std::fprintf(stderr, "%s\n", remark.c_str());
  return bench::rival_of(*both, *setup);
}

}  // namespace

int rival_verb(std::span<const std::string> args) {
  RivalOptions options;
  CommandLine app{
      "pitwall-hil rival: the other car of a race in our track's coordinates, by the GNSS of both "
      "recordings; exit 0 told, 1 at no time both have a position, 2 unusable"};
  app.option("OWN", options.own, "our car's recording: folder of the black box, or a segment")
      .required();
  app.option("OTHER", options.other, "the other car's, likewise").required();
  app.option("--offset", options.offset_s, "seconds that are added to the other's stamps")
      .range(-1e9, 1e9);
  app.option("--car", options.files.car, "our car file; default: the one that OWN names");
  app.option("--track", options.files.track, "track file; likewise");
  app.option("--out", options.out_file, "write every position as CSV");
  if (const auto code = app.ended_by(args)) return *code;
  const auto found = rows_of(options);
  if (!found) return refuse(found.error());
  if (found->rows.empty()) {
    std::printf(
        "no position of both: %zu of ours and %zu of the other lie at other times "
        "(--offset?)\n",
        found->own_positions, found->rival_positions);
    return kExitFailed;
  }
  std::printf("%s", summary_of(found->rows).c_str());
  if (options.out_file.empty()) return kExitPass;
  const auto written = transport::write_file(options.out_file, csv_of(found->rows));
  return written ? kExitPass : refuse(written.error());
}

}  // namespace pitwall::cli

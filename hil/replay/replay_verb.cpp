// SPDX-License-Identifier: Apache-2.0
#include "hil/replay/replay_verb.hpp"

#include <algorithm>
#include <map>
#include <memory>

#include "hil/replay/formats/log_reader.hpp"
#include "hil/replay/frames/database_files.hpp"
#include "hil/replay/player.hpp"
#include "hil/replay/reading/progress_line.hpp"
#include "hil/replay/recordings/can_part.hpp"
#include "hil/replay/recordings/recording_reader.hpp"
#include "hil/replay/replay_clock.hpp"
#include "hil/replay/replay_options.hpp"
#include "hil/replay/replay_summary.hpp"
#include "hil/replay/socket_io.hpp"
#include "hil/replay/timeline.hpp"
#include "protocol/transport/clock.hpp"
#include "protocol/transport/file.hpp"
#include "protocol/transport/file_bytes.hpp"
#include "protocol/transport/realtime.hpp"

namespace pitwall::replay {
namespace {

constexpr int kExitIncomplete = 1;
constexpr int kExitRefused = 2;
constexpr int kPriority = 50;                     // SCHED_FIFO, above everything of a desktop
constexpr Duration kConnectTimeout = seconds(2);  // a car tries to connect twice a second
constexpr Duration kWriteTimeout = seconds(2);    // of a slow line, for what is queued at the end
constexpr Duration kRunUp = milliseconds(20);     // from the last preparation to the first frame
constexpr Duration kLongestReplay = seconds(100LL * 366 * 24 * 3'600);  // what int64 holds, thrice
constexpr int kOutput = 1, kErrors = 2;                                 // descriptors

int refuse(const Problem& problem) {
  transport::write_to(kErrors, to_string(problem) + "\n");
  return kExitRefused;
}

// The options with what the files of --restamp and --overlay say.
Result<ReplayOptions, Problem> with_database(ReplayOptions options) {
  if (!options.manifest_file.empty()) {
    auto rules = load_restamp_rules(options.manifest_file, options.dbc_file);
    if (!rules) return Unexpected{rules.error()};
    options.timeline.restamp = std::make_shared<const RestampRules>(*std::move(rules));
  }
  if (options.overlaid.empty()) return options;
  if (options.dbc_file.empty()) {
    auto path = database_of(options.manifest_file);
    if (!path) return Unexpected{path.error()};
    options.dbc_file = *std::move(path);
  }
  auto nodes = load_nodes(options.dbc_file, options.overlaid);
  if (!nodes) return Unexpected{nodes.error()};
  options.timeline.nodes = *std::move(nodes);
  return options;
}

Result<Timeline, Problem> timeline_of_log(std::string_view text, const ReplayOptions& options) {
  ProgressLine line("reading " + options.file, options.progress);
  const auto log = read_can_log(text, options.file, {.reached = line.function()});
  if (!log) return Unexpected{log.error()};
  transport::write_to(kErrors, to_text(*log, options.file));
  return make_timeline(*log, options.timeline);
}

// A line for each reason, with the sources that it holds for.
std::string left_out_text(const std::vector<LeftOut>& left_out, const std::string& file) {
  std::map<std::string, std::string> sources;
  for (const LeftOut& left : left_out) {
    std::string& listed = sources[left.why];
    listed += (listed.empty() ? "" : ", ") + left.source + " (" + std::to_string(left.records) +
              " records)";
  }
  std::string text;
  for (const auto& [why, listed] : sources)
    text += file + ": not played: " + listed + ": " + why + "\n";
  return text;
}

Result<Timeline, Problem> timeline_of_recording(transport::FileBytes file,
                                                const ReplayOptions& options) {
  ProgressLine line("reading " + options.file, options.progress);
  const auto recording = traffic::read_recording(std::move(file), options.file, line.function());
  if (!recording) return Unexpected{recording.error()};
  std::string remarks;
  for (const traffic::Remark& remark : recording->remarks) remarks += to_string(remark) + "\n";
  transport::write_to(kErrors, remarks);
  return make_timeline(*recording, options.timeline);
}

// File and recording are gone again when it returns: only what is played is locked into memory.
Result<Timeline, Problem> load(const ReplayOptions& options) {
  auto file = transport::FileBytes::map(options.file);
  if (!file) return Unexpected{file.error()};
  auto timeline = traffic::is_recording(file->text())
                      ? timeline_of_recording(*std::move(file), options)
                      : timeline_of_log(file->text(), options);
  if (!timeline) return timeline;
  transport::write_to(kErrors, left_out_text(timeline->left_out, options.file));
  if (timeline->pass.ns > kLongestReplay.ns / options.play.passes)
    return Unexpected{Problem{options.file, "all passes together take more than a century"}};
  return timeline;
}

// What the kernel and the other ends did not take, besides what the player counts.
std::string losses_text(const SocketIo& io, const Timeline& timeline) {
  std::string text;
  if (!io.last_error().empty()) text += "the kernel refused to send: " + io.last_error() + "\n";
  for (std::size_t track = 0; track < timeline.tracks.size(); ++track)
    if (const std::uint64_t undelivered = io.undelivered(track); undelivered > 0)
      text += timeline.tracks[track].target + ": nobody listened to " +
              std::to_string(undelivered) + " datagrams or more\n";
  for (const std::string& topic : io.unread_topics()) text += topic + ": nobody reads it\n";
  return text + to_text(io.streams());
}

bool has_lost_bytes(const SocketIo& io) {
  return std::ranges::any_of(io.streams(),
                             [](const StreamReport& s) { return s.counters.lost_bytes > 0; });
}

Result<PlayReport, Problem> play(const Timeline& timeline, const ReplayOptions& options,
                                 SocketIo& io, ReplayClock& clock,
                                 const transport::RealtimeReport& realtime) {
  Player player(timeline, options.play, io);
  const Duration lead = !clock.is_wall() ? Duration{}
                        : options.lead   ? *options.lead
                                         : SocketIo::measured_lead();
  io.set_lead(lead);
  transport::write_to(kOutput, to_string(realtime) + "; wakes up " +
                                   std::to_string(lead.ns / 1'000) + " us early\n");
  io.wait_for_clients(kConnectTimeout);
  if (const auto begun = clock.begin(); !begun) return Unexpected{begun.error()};
  PlayReport report = player.play(transport::monotonic_now() + kRunUp);
  io.finish(kWriteTimeout);
  return report;
}

}  // namespace

int replay_verb(std::span<const std::string> args) {
  if (!args.empty() && args[0] == "--help")
    return transport::write_to(kOutput, kReplayUsage) ? 0 : kExitRefused;
  auto parsed = parse_replay_options(args);
  if (!parsed) return refuse(parsed.error());
  const auto options = with_database(*std::move(parsed));
  if (!options) return refuse(options.error());
  auto clock = ReplayClock::open(options->clock);
  if (!clock) return refuse(clock.error());
  const auto timeline = load(*options);
  if (!timeline) return refuse(timeline.error());
  auto io = SocketIo::open(*timeline);
  if (!io) return refuse(io.error());
  const auto realtime = transport::request_realtime(kPriority);
  const auto report = play(*timeline, *options, *io, *clock, realtime);
  if (!report) return refuse(report.error());
  const auto waits = clock->end();
  transport::write_to(kOutput, to_text(*report, *timeline) + (waits ? to_text(*waits) : ""));
  transport::write_to(kErrors, losses_text(*io, *timeline));
  if (!options->json_file.empty()) {
    const auto written = transport::write_file(
        options->json_file, to_json(*report, *timeline, io->streams(), realtime, waits));
    if (!written) return refuse(written.error());
  }
  const bool is_incomplete =
      report->dropped() > 0 || report->aborted || report->stopped || has_lost_bytes(*io);
  return is_incomplete ? kExitIncomplete : 0;
}

}  // namespace pitwall::replay

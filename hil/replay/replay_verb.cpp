// SPDX-License-Identifier: Apache-2.0
#include "hil/replay/replay_verb.hpp"

#include <charconv>
#include <map>
#include <optional>

#include "hil/replay/formats/log_reader.hpp"
#include "hil/replay/player.hpp"
#include "hil/replay/recordings/can_part.hpp"
#include "hil/replay/recordings/recording_reader.hpp"
#include "hil/replay/replay_summary.hpp"
#include "hil/replay/socket_rim.hpp"
#include "hil/replay/timeline.hpp"
#include "protocol/transport/clock.hpp"
#include "protocol/transport/file.hpp"
#include "protocol/transport/realtime.hpp"
#include "protocol/transport/udp_socket.hpp"

namespace pitwall::replay {
namespace {

constexpr int kExitIncomplete = 1;
constexpr int kExitRefused = 2;
constexpr int kPriority = 50;                  // SCHED_FIFO, above everything of a desktop
constexpr Duration kRunUp = milliseconds(20);  // from the last preparation to the first frame
constexpr std::int64_t kMaxLate_ms = 3'600'000;
constexpr double kLongest_s = 1e7;
constexpr Duration kLongestReplay = seconds(100LL * 366 * 24 * 3'600);  // what int64 holds, thrice
constexpr int kOutput = 1, kErrors = 2;                                 // descriptors
constexpr unsigned kMaxPasses = 1'000'000;

struct ReplayOptions {
  std::string file;
  TimelineOptions timeline;
  PlayOptions play;
  std::optional<Duration> lead{};  // nothing: as measured
  std::string json_file;
};

int refuse(const Problem& problem) {
  transport::write_to(kErrors, to_string(problem) + "\n");
  return kExitRefused;
}

template <class T>
bool parse_number(std::string_view text, T& out) {
  const auto parsed = std::from_chars(text.data(), text.data() + text.size(), out);
  return parsed.ec == std::errc{} && parsed.ptr == text.data() + text.size();
}

bool take_map(ReplayOptions& out, const std::string& value) {
  const std::size_t equals = value.find('=');
  if (equals == std::string::npos || equals == 0 || equals + 1 == value.size()) return false;
  out.timeline.map.emplace_back(value.substr(0, equals), value.substr(equals + 1));
  return true;
}

bool take_receiver(ReplayOptions& out, const std::string& value) {
  const std::size_t equals = value.rfind('=');
  if (equals == std::string::npos || equals == 0) return false;
  const auto address = transport::parse_udp_address(std::string_view(value).substr(equals + 1));
  if (!address || address->port == 0) return false;
  out.timeline.receivers.emplace_back(value.substr(0, equals), *address);
  return true;
}

bool take_passes(ReplayOptions& out, const std::string& value) {
  return parse_number(value, out.play.passes) && out.play.passes >= 1 &&
         out.play.passes <= kMaxPasses;
}

// catch-up, drop:MS or abort:MS
bool take_late(ReplayOptions& out, const std::string& value) {
  if (value == "catch-up") return out.play.late = LatePolicy::kCatchUp, true;
  const std::size_t colon = value.find(':');
  const std::string policy = value.substr(0, colon);
  if (colon == std::string::npos || (policy != "drop" && policy != "abort")) return false;
  std::int64_t limit_ms = 0;
  if (!parse_number(std::string_view(value).substr(colon + 1), limit_ms)) return false;
  out.play.late = policy == "drop" ? LatePolicy::kDrop : LatePolicy::kAbort;
  out.play.late_limit = milliseconds(limit_ms);
  return limit_ms >= 1 && limit_ms <= kMaxLate_ms;
}

bool take_seconds(Duration& out, const std::string& value) {
  double s = 0.0;
  if (!parse_number(value, s) || !(s >= 0.0 && s <= kLongest_s)) return false;
  out = from_seconds(s);
  return true;
}

bool take_spin(ReplayOptions& out, const std::string& value) {
  std::int64_t us = 0;
  if (!parse_number(value, us) || us < 0 || us > kMaxLead.ns / 1'000) return false;
  out.lead = microseconds(us);
  return true;
}

bool take_id(ReplayOptions& out, const std::string& value) {
  std::uint32_t id = 0;
  const auto end = value.data() + value.size();
  const auto parsed = std::from_chars(value.data(), end, id, 16);
  if (parsed.ec != std::errc{} || parsed.ptr != end || id > can::kMaxExtendedId) return false;
  out.timeline.ids.push_back(id);
  return true;
}

struct OptionRow {
  std::string_view name;
  const char* expected;  // said when take() refuses a value
  bool (*take)(ReplayOptions& out, const std::string& value);
};

constexpr OptionRow kOptions[] = {
    {"--interface", "not an interface name",
     [](ReplayOptions& out, const std::string& value) {
       out.timeline.interface = value;
       return !value.empty();
     }},
    {"--map", "expected RECORDED=INTERFACE", take_map},
    {"--receiver", "expected SOURCE=ADDRESS:PORT with an IPv4 address and a port from 1 to 65535",
     take_receiver},
    {"--speed", "not a speed",
     [](ReplayOptions& out, const std::string& value) {
       return parse_number(value, out.timeline.speed);
     }},
    {"--loop", "not a number of passes from 1 to 1000000", take_passes},
    {"--start", "not a number of seconds from 0 to 1e7",
     [](ReplayOptions& out, const std::string& value) {
       return take_seconds(out.timeline.start, value);
     }},
    {"--skip", "not a number of seconds from 0 to 1e7",
     [](ReplayOptions& out, const std::string& value) {
       return take_seconds(out.timeline.longest_gap, value);
     }},
    {"--id", "not an identifier in hex digits", take_id},
    {"--late", "not catch-up, drop:MS or abort:MS with 1 to 3600000 ms", take_late},
    {"--spin", "not a number of microseconds from 0 to 200", take_spin},
    {"--json", "not a file name",
     [](ReplayOptions& out, const std::string& value) {
       out.json_file = value;
       return !value.empty();
     }},
};

std::optional<Problem> take_option(ReplayOptions& out, const std::string& option,
                                   const std::string& value) {
  for (const OptionRow& row : kOptions) {
    if (row.name != option) continue;
    if (row.take(out, value)) return std::nullopt;
    return Problem{value, row.expected};
  }
  return Problem{option, "unknown option"};
}

Result<ReplayOptions, Problem> parse_options(std::span<const std::string> args) {
  ReplayOptions out;
  for (std::size_t i = 0; i < args.size(); ++i) {
    if (!args[i].starts_with("--")) {
      if (!out.file.empty()) return Unexpected{Problem{args[i], "more than one recording"}};
      out.file = args[i];
      continue;
    }
    if (i + 1 == args.size()) return Unexpected{Problem{args[i], "its value is missing"}};
    if (auto problem = take_option(out, args[i], args[i + 1])) return Unexpected{*problem};
    ++i;
  }
  if (out.file.empty())
    return Unexpected{Problem{"replay", "expected FILE: a CAN log or a recording"}};
  return out;
}

Result<Timeline, Problem> timeline_of_log(const std::string& text, const ReplayOptions& options) {
  const auto log = read_can_log(text, options.file);
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

Result<Timeline, Problem> timeline_of_recording(std::string file, const ReplayOptions& options) {
  const auto recording = traffic::read_recording(std::move(file), options.file);
  if (!recording) return Unexpected{recording.error()};
  std::string said;
  for (const traffic::Remark& remark : recording->remarks) said += to_string(remark) + "\n";
  auto timeline = make_timeline(*recording, options.timeline);
  if (timeline) said += left_out_text(timeline->left_out, options.file);
  transport::write_to(kErrors, said);
  return timeline;
}

// File and recording are gone again when it returns: only what is played is locked into memory.
Result<Timeline, Problem> load(const ReplayOptions& options) {
  auto file = transport::read_file(options.file);
  if (!file) return Unexpected{file.error()};
  auto timeline = traffic::is_recording(*file) ? timeline_of_recording(*std::move(file), options)
                                               : timeline_of_log(*file, options);
  if (!timeline) return timeline;
  if (timeline->pass.ns > kLongestReplay.ns / options.play.passes)
    return Unexpected{Problem{options.file, "all passes together take more than a century"}};
  return timeline;
}

constexpr const char* kUsage =
    "replay FILE [--interface IFACE] [--map RECORDED=IFACE]...\n"
    "       [--receiver SOURCE=ADDRESS:PORT]... [--speed X] [--loop N] [--start S] [--skip S]\n"
    "       [--id HEX]... [--late catch-up|drop:MS|abort:MS] [--spin US] [--json FILE]\n"
    "plays a CAN log in real time: candump, Vector ASC and BLF, PEAK TRC, pcap, pcapng, also with\n"
    "gzip; records that do not read are left out and told. Without --interface and --map every\n"
    "channel goes to the interface that it was recorded from, channel 1 of Vector and PEAK to "
    "can0\n"
    "plays a recording likewise: the car's black box and bags (MCAP, SQLite), LCM logs, bytes of\n"
    "a receiver. CAN topics need --interface or --map; /can/out, which the car said, needs --map\n"
    "  --receiver  bytes of a receiver as UDP datagrams to an address, in order with the frames\n"
    "  --start S   leave out the first S seconds    --skip S    do not wait through longer gaps\n"
    "  --id HEX    only these identifiers           --loop N    so many passes without a seam\n"
    "  --late      what is later than MS: sent at once (catch-up, the default), dropped, or the "
    "end\n"
    "  --spin US   wake up so early and wait busily, 0 to 200; default: what sleeps are late here\n"
    "exit codes: 0 all sent, 1 something dropped or ended early, 2 bad input\n";

}  // namespace

int replay_verb(std::span<const std::string> args) {
  if (!args.empty() && args[0] == "--help") return transport::write_to(kOutput, kUsage) ? 0 : 2;
  const auto options = parse_options(args);
  if (!options) return refuse(options.error());
  const auto timeline = load(*options);
  if (!timeline) return refuse(timeline.error());
  auto rim = SocketRim::open(*timeline);
  if (!rim) return refuse(rim.error());
  Player player(*timeline, options->play, *rim);
  const auto realtime = transport::request_realtime(kPriority);
  const Duration lead = options->lead ? *options->lead : SocketRim::measured_lead();
  rim->set_lead(lead);
  transport::write_to(kOutput, to_string(realtime) + "; wakes up " +
                                   std::to_string(lead.ns / 1'000) + " us early\n");
  const PlayReport report = player.play(transport::monotonic_now() + kRunUp);
  transport::write_to(kOutput, to_text(report, *timeline));
  if (!rim->last_error().empty())
    transport::write_to(kErrors, "the kernel refused to send: " + rim->last_error() + "\n");
  for (std::size_t track = 0; track < timeline->tracks.size(); ++track)
    if (const std::uint64_t unheard = rim->unheard(track); unheard > 0)
      transport::write_to(kErrors, timeline->tracks[track].target + ": nobody listened to " +
                                       std::to_string(unheard) + " datagrams or more\n");
  if (!options->json_file.empty()) {
    const auto written =
        transport::write_file(options->json_file, to_json(report, *timeline, realtime));
    if (!written) return refuse(written.error());
  }
  return report.dropped() > 0 || report.aborted || report.stopped ? kExitIncomplete : 0;
}

}  // namespace pitwall::replay

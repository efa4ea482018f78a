// SPDX-License-Identifier: Apache-2.0
#include "hil/replay/replay_verb.hpp"

#include <charconv>
#include <optional>

#include "hil/replay/candump_log.hpp"
#include "hil/replay/player.hpp"
#include "hil/replay/timeline.hpp"
#include "protocol/transport/can_socket.hpp"
#include "protocol/transport/clock.hpp"
#include "protocol/transport/file.hpp"
#include "protocol/transport/process.hpp"
#include "protocol/transport/readiness.hpp"
#include "protocol/transport/realtime.hpp"

namespace pitwall::replay {
namespace {

constexpr int kExitIncomplete = 1;
constexpr int kExitRefused = 2;
constexpr int kPriority = 50;                  // SCHED_FIFO, above everything of a desktop
constexpr Duration kRunUp = milliseconds(20);  // from the last preparation to the first frame
constexpr Duration kExactWait = milliseconds(5);
constexpr int kOutput = 1, kErrors = 2;  // descriptors
constexpr unsigned kMaxPasses = 1'000'000;

struct ReplayOptions {
  std::string file;
  TimelineOptions timeline;
  PlayOptions play;
};

int refuse(const Problem& problem) {
  transport::write_to(kErrors, to_string(problem) + "\n");
  return kExitRefused;
}

template <class T>
bool parse_number(const std::string& text, T& out) {
  const auto parsed = std::from_chars(text.data(), text.data() + text.size(), out);
  return parsed.ec == std::errc{} && parsed.ptr == text.data() + text.size();
}

std::optional<Problem> take_option(ReplayOptions& out, const std::string& option,
                                   const std::string& value) {
  if (option == "--interface") {
    out.timeline.interface = value;
  } else if (option == "--map") {
    const std::size_t equals = value.find('=');
    if (equals == std::string::npos || equals == 0 || equals + 1 == value.size())
      return Problem{value, "expected RECORDED=INTERFACE"};
    out.timeline.map.emplace_back(value.substr(0, equals), value.substr(equals + 1));
  } else if (option == "--speed") {
    if (!parse_number(value, out.timeline.speed)) return Problem{value, "not a speed"};
  } else if (option == "--loop") {
    if (!parse_number(value, out.play.passes) || out.play.passes == 0 ||
        out.play.passes > kMaxPasses)
      return Problem{value, "not a number of passes from 1 to 1000000"};
  } else if (option == "--late") {
    if (value != "catch-up" && value != "abort") return Problem{value, "not catch-up or abort"};
    out.play.late = value == "abort" ? LatePolicy::kAbort : LatePolicy::kCatchUp;
  } else {
    return Problem{option, "unknown option"};
  }
  return std::nullopt;
}

Result<ReplayOptions, Problem> parse_options(std::span<const std::string> args) {
  ReplayOptions out;
  for (std::size_t i = 0; i < args.size(); ++i) {
    if (!args[i].starts_with("--")) {
      if (!out.file.empty()) return Unexpected{Problem{args[i], "more than one log"}};
      out.file = args[i];
      continue;
    }
    if (i + 1 == args.size()) return Unexpected{Problem{args[i], "its value is missing"}};
    if (auto problem = take_option(out, args[i], args[i + 1])) return Unexpected{*problem};
    ++i;
  }
  if (out.file.empty()) return Unexpected{Problem{"replay", "expected FILE.log"}};
  return out;
}

// The player's rim on this machine: real clock, real sockets.
struct SocketRim {
  std::vector<transport::CanSocket> sockets;
  transport::StopSignal stop;

  Instant now() { return transport::monotonic_now(); }
  // A long gap ends with a stop signal; the last stretch is the clock's exact wait.
  void wait_until(Instant deadline) {
    const int watched[] = {stop.fd()};
    if (deadline - now() > 2 * kExactWait) transport::wait_readable(watched, deadline - kExactWait);
    if (!stop.raised()) transport::sleep_until(deadline);
  }
  std::size_t send(std::size_t bus, std::span<const can::Frame> frames) {
    return sockets[bus].send(frames);
  }
  bool stopped() { return stop.raised(); }
};

Result<std::vector<transport::CanSocket>, Problem> open_buses(const Timeline& timeline) {
  std::vector<transport::CanSocket> out;
  const std::vector<transport::CanFilter> nothing{
      {.id = 0, .mask = can::kMaxExtendedId, .extended = true}};
  for (const BusTrack& bus : timeline.buses) {
    auto socket =
        transport::CanSocket::open(bus.interface, {.filters = nothing, .receive_errors = false});
    if (!socket) return Unexpected{socket.error()};
    out.push_back(*std::move(socket));
  }
  return out;
}

std::string warnings(const CandumpCounters& c, const std::string& file) {
  const std::string start = file + ": warning: ";
  std::string out;
  if (c.backward_stamps > 0)
    out += start + std::to_string(c.backward_stamps) +
           " stamps go back; the order of the log is kept\n";
  if (c.recorder_drops > 0)
    out += start + "the recorder itself lost " + std::to_string(c.recorder_drops) + " frames\n";
  if (c.error_frames > 0)
    out += start + std::to_string(c.error_frames) + " error frames are not replayed\n";
  return out;
}

std::string microseconds_text(Duration d) { return std::to_string(d.ns / 1'000) + " us"; }

std::string summary(const PlayReport& report) {
  const auto& late = report.lateness;
  std::string out = "sent " + std::to_string(report.sent) + " frames in " +
                    std::to_string(report.took.seconds()) + " s (" + std::to_string(report.calls) +
                    " calls, " + std::to_string(report.retries) + " retries, " +
                    std::to_string(report.dropped) + " dropped)\n";
  if (late.count() > 0)
    out += "lateness p50 " + microseconds_text(late.quantile(0.5)) + ", p90 " +
           microseconds_text(late.quantile(0.9)) + ", p99 " +
           microseconds_text(late.quantile(0.99)) + ", max " + microseconds_text(late.latest()) +
           "\n";
  if (report.aborted) out += "aborted: a frame was later than allowed\n";
  if (report.stopped) out += "stopped by a signal\n";
  return out;
}

constexpr const char* kUsage =
    "replay FILE.log [--interface IFACE] [--map RECORDED=IFACE]... [--speed X] [--loop N]\n"
    "       [--late catch-up|abort]\n"
    "plays a candump log in real time; without --interface and --map every channel goes to the\n"
    "interface that it was recorded from\n"
    "exit codes: 0 all sent, 1 frames dropped or replay ended early, 2 bad input\n";

}  // namespace

int replay_verb(std::span<const std::string> args) {
  if (!args.empty() && args[0] == "--help") return transport::write_to(kOutput, kUsage) ? 0 : 2;
  const auto options = parse_options(args);
  if (!options) return refuse(options.error());
  const auto text = transport::read_file(options->file);
  if (!text) return refuse(text.error());
  const auto log = parse_candump_log(*text, options->file);
  if (!log) return refuse(log.error());
  const auto timeline = make_timeline(*log, options->timeline);
  if (!timeline) return refuse(timeline.error());
  transport::write_to(kErrors, warnings(log->counters, options->file));
  auto sockets = open_buses(*timeline);
  if (!sockets) return refuse(sockets.error());
  auto stop = transport::StopSignal::install();
  if (!stop) return refuse(stop.error());
  SocketRim rim{*std::move(sockets), *std::move(stop)};
  const auto realtime = transport::request_realtime(kPriority);
  transport::write_to(kOutput, to_string(realtime) + "\n");
  Player player(*timeline, options->play, rim);
  const PlayReport report = player.play(transport::monotonic_now() + kRunUp);
  transport::write_to(kOutput, summary(report));
  return report.dropped > 0 || report.aborted || report.stopped ? kExitIncomplete : 0;
}

}  // namespace pitwall::replay

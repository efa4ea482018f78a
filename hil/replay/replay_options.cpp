// SPDX-License-Identifier: Apache-2.0
#include "hil/replay/replay_options.hpp"

#include <charconv>

#include "hil/replay/socket_io.hpp"

namespace pitwall::replay {
namespace {

constexpr std::int64_t kMaxLate_ms = 3'600'000;
constexpr double kLongest_s = 1e7;
constexpr unsigned kMaxPasses = 1'000'000;

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
  const std::size_t equals = value.find('=');
  if (equals == std::string::npos || equals == 0) return false;
  auto target = parse_receiver_target(std::string_view(value).substr(equals + 1));
  if (!target) return false;
  out.timeline.receivers.emplace_back(value.substr(0, equals), *std::move(target));
  return true;
}

// DOMAIN or DOMAIN@ADDRESS
bool take_dds(ReplayOptions& out, const std::string& value) {
  const std::size_t at = value.find('@');
  dds::DomainConfig config;
  if (!parse_number(std::string_view(value).substr(0, at), config.domain)) return false;
  if (at != std::string::npos) config.interface = value.substr(at + 1);
  out.timeline.dds = config;
  return config.domain >= 0 && config.domain <= dds::kDomainMax &&
         transport::parse_udp_address(config.interface + ":1").has_value();
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

bool take_id(std::vector<std::uint32_t>& out, const std::string& value) {
  std::uint32_t id = 0;
  const auto end = value.data() + value.size();
  const auto parsed = std::from_chars(value.data(), end, id, 16);
  if (parsed.ec != std::errc{} || parsed.ptr != end || id > can::kMaxExtendedId) return false;
  out.push_back(id);
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
    {"--receiver",
     "expected SOURCE=ADDRESS:PORT, SOURCE=tcp:ADDRESS:PORT (an IPv4 address, a port from 1 to "
     "65535) or SOURCE=serial:/dev/DEVICE[:BAUD] with a rate that a tty has",
     take_receiver},
    {"--dds",
     "expected DOMAIN or DOMAIN@ADDRESS: a domain from 0 to 101, the IPv4 address of an interface",
     take_dds},
    {"--speed", "not a speed",
     [](ReplayOptions& out, const std::string& value) {
       return parse_number(value, out.timeline.speed);
     }},
    {"--loop", "not a number of passes from 1 to 1000000", take_passes},
    {"--from", "not a number of seconds from 0 to 1e7",
     [](ReplayOptions& out, const std::string& value) {
       return take_seconds(out.timeline.from, value);
     }},
    {"--until", "not a number of seconds from 0 to 1e7",
     [](ReplayOptions& out, const std::string& value) {
       return take_seconds(out.timeline.until, value);
     }},
    {"--skip", "not a number of seconds from 0 to 1e7",
     [](ReplayOptions& out, const std::string& value) {
       return take_seconds(out.timeline.longest_gap, value);
     }},
    {"--topic", "not the name of a source",
     [](ReplayOptions& out, const std::string& value) {
       out.timeline.topics.push_back(value);
       return !value.empty();
     }},
    {"--id", "not an identifier in hex digits",
     [](ReplayOptions& out, const std::string& value) { return take_id(out.timeline.ids, value); }},
    {"--not-id", "not an identifier in hex digits",
     [](ReplayOptions& out, const std::string& value) {
       return take_id(out.timeline.not_ids, value);
     }},
    {"--restamp", "not a file name",
     [](ReplayOptions& out, const std::string& value) {
       out.manifest_file = value;
       return !value.empty();
     }},
    {"--overlay", "not the name of a node",
     [](ReplayOptions& out, const std::string& value) {
       out.overlaid.push_back(value);
       return !value.empty();
     }},
    {"--dbc", "not a file name",
     [](ReplayOptions& out, const std::string& value) {
       out.dbc_file = value;
       return !value.empty();
     }},
    {"--late", "not catch-up, drop:MS or abort:MS with 1 to 3600000 ms", take_late},
    {"--spin", "not a number of microseconds from 0 to 200", take_spin},
    {"--clock", "expected wall or FILE: that of the programs that the replay is played to",
     [](ReplayOptions& out, const std::string& value) {
       out.clock = value;
       return value == transport::kWallClock || value.find('/') != std::string::npos;
     }},
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

}  // namespace

Result<ReplayOptions, Problem> parse_replay_options(std::span<const std::string> args) {
  ReplayOptions out;
  for (std::size_t i = 0; i < args.size(); ++i) {
    if (!args[i].starts_with("--")) {
      if (!out.file.empty()) return Unexpected{Problem{args[i], "more than one recording"}};
      out.file = args[i];
      continue;
    }
    if (args[i] == "--progress") {
      out.progress = true;
      continue;
    }
    if (i + 1 == args.size()) return Unexpected{Problem{args[i], "its value is missing"}};
    if (auto problem = take_option(out, args[i], args[i + 1])) return Unexpected{*problem};
    ++i;
  }
  if (out.file.empty())
    return Unexpected{Problem{"replay", "expected FILE: a CAN log or a recording"}};
  if (out.lead && out.clock != transport::kWallClock)
    return Unexpected{
        Problem{"--spin", "allowed with --clock wall only, because bench time can pause"}};
  if (!out.overlaid.empty() && out.dbc_file.empty() && out.manifest_file.empty())
    return Unexpected{
        Problem{"--overlay", "needs --dbc FILE too, which names the sender of each message"}};
  if (out.overlaid.empty() && out.manifest_file.empty() && !out.dbc_file.empty())
    return Unexpected{Problem{"--dbc", "has no use without --overlay or --restamp"}};
  return out;
}

const char* const kReplayUsage =
    "replay FILE [--interface IFACE] [--map RECORDED=IFACE]...\n"
    "       [--receiver SOURCE=TARGET]... [--dds DOMAIN[@ADDRESS]] [--speed X] [--loop N]\n"
    "       [--from S] [--until S] [--skip S] [--topic NAME]... [--id HEX]... [--not-id HEX]...\n"
    "       [--overlay NODE]... [--dbc FILE] [--restamp MANIFEST]\n"
    "       [--late catch-up|drop:MS|abort:MS] [--spin US] [--clock wall|FILE]\n"
    "       [--json FILE] [--progress]\n"
    "plays a CAN log in real time: candump, Vector ASC and BLF, PEAK TRC, pcap, pcapng, also with\n"
    "gzip; records that do not read are left out and told. Without --interface and --map every\n"
    "channel goes to the interface that it was recorded from, channel 1 of Vector and PEAK to "
    "can0\n"
    "plays a recording likewise: the car's black box and bags (MCAP, SQLite), LCM logs, bytes of\n"
    "a receiver. CAN topics need --interface or --map; /can/out, which the car said, needs --map\n"
    "  --receiver  bytes of a receiver, in order with the frames: to ADDRESS:PORT by UDP, to\n"
    "              whoever connects to tcp:ADDRESS:PORT, or to serial:/dev/DEVICE[:BAUD]\n"
    "  --dds       its ROS 2 topics with their recorded bytes, on loopback or the interface\n"
    "              that has ADDRESS\n"
    "  --from S    leave out the first S seconds    --until S   end S seconds after the first "
    "stamp\n"
    "  --skip S    do not wait through longer gaps  --loop N    so many passes without a seam\n"
    "  --topic     only these sources or channels   --id HEX, --not-id HEX  only, but these "
    "frames\n"
    "  --overlay   all but the messages that this node of the database sends\n"
    "  --restamp   rolling counters and checksums made anew by a car's manifest, also over loops\n"
    "  --late      what is later than MS: sent at once (catch-up, the default), dropped, or the "
    "end\n"
    "  --spin US   wake up so early and wait busily, 0 to 200; default: what sleeps are late here\n"
    "  --clock     the bench time in FILE, as of the programs that it plays to: where the machine\n"
    "              holds one of them up, the replay waits as well; default: wall\n"
    "  --progress  say how far reading is once a second, also where there is no terminal\n"
    "exit codes: 0 all sent, 1 something dropped or ended early, 2 bad input\n";

}  // namespace pitwall::replay

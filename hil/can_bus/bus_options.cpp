// SPDX-License-Identifier: Apache-2.0
#include "hil/can_bus/bus_options.hpp"

#include <charconv>
#include <cmath>

#include "hil/can_bus/init_script.hpp"
#include "protocol/transport/can/unix_bus.hpp"

namespace pitwall::can_bus {
namespace {

constexpr double kLongestTimeout_s = 86'400.0;
constexpr int kMostMemory_mib = 16'384;
constexpr std::uint32_t kBitrateLeast = 5'000, kBitrateMost = 1'000'000;  // classic CAN, bit/s
constexpr std::uint32_t kRestartMost_ms = 60'000, kQueueMost_frames = 10'000;

template <class T>
std::optional<T> parse_number(const std::string& text) {
  T value{};
  const auto parsed = std::from_chars(text.data(), text.data() + text.size(), value);
  if (parsed.ec != std::errc{} || parsed.ptr != text.data() + text.size()) return std::nullopt;
  return value;
}

std::optional<Duration> parse_seconds(const std::string& text) {
  const auto number = parse_number<double>(text);
  if (!number || !(*number > 0.0 && *number <= kLongestTimeout_s)) return std::nullopt;
  return from_seconds(*number);
}

// Interface names go into a shell script and to `ip`: plain words only, as long as the kernel
// allows.
bool is_interface_name(const std::string& name) {
  constexpr std::size_t kLongest = 15;
  return !name.empty() && name.size() <= kLongest && name[0] != '-' &&
         name.find_first_not_of(
             "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-"
             ".") == std::string::npos;
}

std::optional<Problem> take_value(BusExecOptions& out, const std::string& option,
                                  const std::string& value) {
  if (option == "--interface") {
    if (!is_interface_name(value)) return Problem{value, "not an interface name"};
    out.interfaces.push_back(value);
  } else if (option == "--timeout") {
    out.timeout = parse_seconds(value);
    if (!out.timeout) return Problem{value, "not a time-out in seconds"};
  } else if (option == "--memory") {
    const auto memory_mib = parse_number<int>(value);
    if (!memory_mib || *memory_mib < kLeastMemory_mib || *memory_mib > kMostMemory_mib)
      return Problem{value, "not a memory size in MiB from 96 to 16384"};
    out.memory_mib = *memory_mib;
  } else if (option == "--clock") {
    if (value.empty()) return Problem{option, "expected a file"};
    out.clock = value;
  } else if (option == "--line-udp") {
    const auto ports = parse_line_ports(value);
    if (!ports) return ports.error();
    out.line = *ports;
  } else {
    return Problem{option, "unknown option"};
  }
  return std::nullopt;
}

// One number of a real interface.
std::optional<Problem> take_setting(transport::CanInterfaceSettings& out, const std::string& option,
                                    const std::string& value) {
  const auto number = parse_number<std::uint32_t>(value);
  const auto within = [&](std::uint32_t least, std::uint32_t most) {
    return number && *number >= least && *number <= most;
  };
  if (option == "--bitrate") {
    if (!within(kBitrateLeast, kBitrateMost))
      return Problem{value, "not a bit rate from 5000 to 1000000 bit/s"};
    out.bitrate = number;
  } else if (option == "--restart-ms") {
    if (!within(0, kRestartMost_ms)) return Problem{value, "not a time from 0 (never) to 60000 ms"};
    out.restart_ms = number;
  } else if (option == "--txqueuelen") {
    if (!within(1, kQueueMost_frames))
      return Problem{value, "not a queue length from 1 to 10000 frames"};
    out.tx_queue_frames = number;
  } else {
    return Problem{option, "unknown option"};
  }
  return std::nullopt;
}

}  // namespace

Result<BusExecOptions, Problem> parse_bus_exec(std::span<const std::string> args) {
  BusExecOptions out;
  std::size_t i = 0;
  for (; i < args.size() && args[i] != "--"; ++i) {
    if (args[i] == "--auto") {
      out.place = BusPlace::kAuto;
    } else if (args[i] == "--native") {
      out.place = BusPlace::kNative;
    } else if (args[i] == "--guest") {
      out.place = BusPlace::kGuest;
    } else if (i + 1 < args.size() && args[i + 1] != "--") {
      if (auto problem = take_value(out, args[i], args[i + 1]))
        return Unexpected{*std::move(problem)};
      ++i;
    } else {
      return Unexpected{Problem{args[i], "unknown option, or its value is missing"}};
    }
  }
  if (i + 1 >= args.size()) return Unexpected{Problem{"bus exec", "expected -- COMMAND ARG..."}};
  out.command.assign(args.begin() + static_cast<std::ptrdiff_t>(i) + 1, args.end());
  if (out.interfaces.empty()) out.interfaces = {"vcan0"};
  return out;
}

Result<BusUpOptions, Problem> parse_bus_up(std::span<const std::string> args) {
  BusUpOptions out;
  // Without --listen-only an interface that was set up to listen speaks again.
  transport::CanInterfaceSettings settings{.listen_only = false};
  bool any = false;
  for (std::size_t i = 0; i < args.size(); ++i) {
    if (!args[i].starts_with("--")) {
      if (!is_interface_name(args[i])) return Unexpected{Problem{args[i], "not an interface name"}};
      out.interfaces.push_back(args[i]);
      continue;
    }
    any = true;
    if (args[i] == "--listen-only") {
      settings.listen_only = true;
    } else if (i + 1 < args.size()) {
      if (auto problem = take_setting(settings, args[i], args[i + 1]))
        return Unexpected{*std::move(problem)};
      ++i;
    } else {
      return Unexpected{Problem{args[i], "unknown option, or its value is missing"}};
    }
  }
  if (any && out.interfaces.empty())
    return Unexpected{Problem{"bus up", "expected the interface that the options are for"}};
  if (any) out.settings = settings;
  if (out.interfaces.empty()) out.interfaces = {"vcan0"};
  return out;
}

Result<BusHubOptions, Problem> parse_bus_hub(std::span<const std::string> args) {
  BusHubOptions out;
  for (std::size_t i = 0; i < args.size(); ++i) {
    if (args[i] == "--seconds" && i + 1 < args.size()) {
      out.length = parse_seconds(args[++i]);
      if (!out.length) return Unexpected{Problem{args[i], "not a time in seconds"}};
    } else if (args[i] == "--clock" && i + 1 < args.size() && !args[i + 1].empty()) {
      out.clock = args[++i];
    } else if (args[i].starts_with("--") || !out.bus.empty()) {
      return Unexpected{Problem{args[i], "unknown option, or its value is missing"}};
    } else {
      out.bus = transport::is_unix_bus(args[i]) ? args[i]
                                                : std::string(transport::kUnixBusPrefix) + args[i];
    }
  }
  if (out.bus.empty()) return Unexpected{Problem{"bus hub", "expected PATH"}};
  return out;
}

}  // namespace pitwall::can_bus

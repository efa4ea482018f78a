// SPDX-License-Identifier: Apache-2.0
#include "hil/replay/writers/candump_writer.hpp"

#include <array>
#include <cstdio>

namespace pitwall::replay {

std::string to_candump_line(const LoggedFrame& logged, std::string_view channel) {
  const can::Frame& f = logged.frame;
  const auto whole_s = static_cast<long long>(logged.at.ns / kNanosecondsPerSecond);
  const auto rest_ns = static_cast<long long>(logged.at.ns % kNanosecondsPerSecond);
  std::array<char, 64> start{};
  if (rest_ns % 1'000 == 0)
    std::snprintf(start.data(), start.size(), "(%010lld.%06lld) ", whole_s, rest_ns / 1'000);
  else
    std::snprintf(start.data(), start.size(), "(%010lld.%09lld) ", whole_s, rest_ns);
  std::array<char, 16> id{};
  std::snprintf(id.data(), id.size(), f.extended ? "%08X#" : "%03X#", f.id);
  std::string out = start.data() + std::string(channel) + " " + id.data();
  constexpr const char* kHex = "0123456789ABCDEF";
  if (f.fd) out += {'#', kHex[logged.fd_flags & 0xFU]};
  if (f.remote) {
    out += 'R';
    if (f.length > 0) out += kHex[f.length];
  } else {
    for (const std::uint8_t byte : f.payload()) out += {kHex[byte >> 4U], kHex[byte & 0xFU]};
  }
  if (logged.direction == LoggedDirection::kTransmitted) out += " T";
  if (logged.direction == LoggedDirection::kReceived) out += " R";
  return out;
}

std::string to_candump(const CanLog& log) {
  std::string out;
  for (const LoggedFrame& logged : log.frames)
    out += to_candump_line(logged, log.channels[logged.channel]) + "\n";
  return out;
}

}  // namespace pitwall::replay

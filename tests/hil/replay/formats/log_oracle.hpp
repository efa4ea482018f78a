// CAN logs as python-can reads and writes them (log_oracle.py), and the comparison with ours.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <sstream>
#include <string>
#include <vector>

#include "hil/replay/formats/can_log.hpp"
#include "protocol/transport/file.hpp"

namespace pitwall::replay::oracle {

struct Message {
  char kind = 'F';  // F: frame, E: error frame, X: refused by python-can's own check, Q: it stopped
  double at_s = 0.0;
  std::string channel;
  LoggedFrame logged;
};

inline std::string hex_of(const can::Frame& f) {
  constexpr const char* kDigits = "0123456789abcdef";
  std::string out;
  if (f.remote) return "-";
  for (const std::uint8_t byte : f.payload()) out += {kDigits[byte >> 4U], kDigits[byte & 15U]};
  return out.empty() ? "-" : out;
}

// Runs a command of the oracle and returns its output.
inline std::string run(const std::string& arguments, const std::string& folder,
                       const std::string& input = {}) {
  const std::string in = folder + "/oracle.in", out = folder + "/oracle.out";
  EXPECT_TRUE(transport::write_file(in, input));
  const std::string command = "TZ=UTC /usr/bin/python3 '" PITWALL_SOURCE_DIR
                              "/tests/hil/replay/formats/log_oracle.py' " +
                              arguments + " < '" + in + "' > '" + out + "' 2> '" + out + ".err'";
  EXPECT_EQ(std::system(command.c_str()), 0)  // NOLINT: a test
      << transport::read_file(out + ".err").value_or("");
  return transport::read_file(out).value_or("");
}

inline Message message_of(const std::string& line) {
  std::istringstream words(line);
  Message out;
  std::string first, data;
  words >> first;
  if (first == "E" || first == "X" || first == "Q") {
    out.kind = first[0];
    words >> out.at_s;
    return out;
  }
  out.at_s = std::stod(first);
  bool extended = false, remote = false, fd = false, rate = false, state = false, received = false;
  unsigned length = 0;
  can::Frame& f = out.logged.frame;
  words >> out.channel >> f.id >> extended >> remote >> fd >> rate >> state >> received >> length >>
      data;
  f.extended = extended;
  f.remote = remote;
  f.fd = fd;
  f.length = static_cast<std::uint8_t>(length);
  out.logged.fd_flags = static_cast<std::uint8_t>((rate ? 1 : 0) | (state ? 2 : 0));
  out.logged.direction = received ? LoggedDirection::kReceived : LoggedDirection::kTransmitted;
  for (std::size_t i = 0; data != "-" && i < length; ++i)
    f.data[i] = static_cast<std::uint8_t>(std::stoul(data.substr(2 * i, 2), nullptr, 16));
  return out;
}

inline std::vector<Message> read(const std::string& format, const std::string& path,
                                 const std::string& folder) {
  std::vector<Message> out;
  std::istringstream lines(run("read " + format + " '" + path + "'", folder));
  for (std::string line; std::getline(lines, line);) out.push_back(message_of(line));
  return out;
}

// Lets python-can write the frames of a log; channels are numbers, as its formats need them.
inline void write(const std::string& format, const std::string& path, const CanLog& log,
                  const std::string& folder, std::size_t error_frames = 0) {
  std::string list;
  for (const LoggedFrame& l : log.frames) {
    const can::Frame& f = l.frame;
    char start[160];
    std::snprintf(start, sizeof start, "%lld.%09lld %d %u %d %d %d %d %d %d %d ",
                  static_cast<long long>(l.at.ns / 1'000'000'000),
                  static_cast<long long>(l.at.ns % 1'000'000'000), l.channel, f.id, f.extended,
                  f.remote, f.fd, l.fd_flags & 1, l.fd_flags >> 1 & 1,
                  l.direction != LoggedDirection::kTransmitted, f.length);
    list += start + hex_of(f) + "\n";
  }
  for (std::size_t i = 0; i < error_frames; ++i)
    list += "E " + std::to_string(log.frames.back().at.ns / 1'000'000'000) + ".5\n";
  run("write " + format + " '" + path + "'", folder, list);
}

struct Tolerance {
  bool relative = false;  // stamps count from the first frame only
  bool direction = true;  // the format keeps the direction for both readers
  int first_channel = 0;  // python-can's number of can0
  double stamp_s = 1e-6;  // python-can's stamps are doubles
};

// A frame that python-can reads and refuses itself must be left out with a remark by ours, or read.
inline void expect_same(const CanLog& ours, const std::vector<Message>& theirs,
                        const Tolerance& tolerance) {
  std::vector<Message> wanted;
  std::size_t errors = 0, refused = 0, understood = 0;
  for (const Message& m : theirs) {
    if (m.kind == 'E') ++errors;
    if (m.kind == 'X') ++refused;
    if (m.kind == 'F') wanted.push_back(m);
  }
  EXPECT_EQ(ours.counters.error_frames, errors);
  const auto seconds = [](UtcTime at) { return static_cast<double>(at.ns) * 1e-9; };
  std::size_t next = 0;
  double shift_s = 0.0;
  for (const LoggedFrame& logged : ours.frames) {
    const bool is_theirs_refused = std::any_of(theirs.begin(), theirs.end(), [&](const Message& m) {
      return m.kind == 'X' && std::abs(m.at_s - seconds(logged.at)) < tolerance.stamp_s;
    });
    if (is_theirs_refused) {
      ++understood;
      continue;
    }
    if (next == wanted.size() && theirs.back().kind == 'Q') return;  // the rest is not judged
    ASSERT_LT(next, wanted.size());
    const Message& m = wanted[next++];
    if (tolerance.relative && next == 1) shift_s = seconds(logged.at) - m.at_s;
    ASSERT_NEAR(seconds(logged.at) - shift_s, m.at_s, tolerance.stamp_s) << next;
    ASSERT_EQ(logged.frame, m.logged.frame) << next << " " << hex_of(logged.frame);
    ASSERT_EQ(logged.fd_flags & 3, m.logged.fd_flags) << next;
    const bool is_number = !m.channel.empty() && std::isdigit(m.channel[0]);
    const std::string channel =
        is_number ? "can" + std::to_string(std::stoi(m.channel) - tolerance.first_channel)
                  : m.channel;
    ASSERT_EQ(ours.channels[logged.channel], channel) << next;
    if (tolerance.direction) {
      ASSERT_EQ(logged.direction, m.logged.direction) << next;
    }
  }
  EXPECT_EQ(next, wanted.size());
  EXPECT_EQ(ours.counters.bad_records, refused - understood);
}

}  // namespace pitwall::replay::oracle

// CAN logs as tshark dissects them, and the comparison with ours.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <sstream>
#include <string>
#include <vector>

#include "protocol/transport/file.hpp"
#include "tests/hil/replay/formats/log_oracle.hpp"

namespace pitwall::replay::oracle {

// One line per packet: stamp, id, extended, remote, error, length, BRS, ESI, data, protocols.
inline std::vector<std::vector<std::string>> tshark_rows(const std::string& path,
                                                         const std::string& folder) {
  const std::string out = folder + "/tshark.out";
  const std::string command =
      "HOME='" + folder + "' TZ=UTC tshark -r '" + path +
      "' -T fields -E separator=, -e frame.time_epoch -e can.id -e can.flags.xtd -e can.flags.rtr "
      "-e can.flags.err -e can.len -e canfd.flags.brs -e canfd.flags.esi -e data.data "
      "-e frame.protocols > '" +
      out + "' 2> '" + out + ".err'";
  EXPECT_EQ(std::system(command.c_str()), 0)  // NOLINT: a test
      << transport::read_file(out + ".err").value_or("");
  std::istringstream lines(transport::read_file(out).value_or(""));
  std::vector<std::vector<std::string>> rows;
  for (std::string line; std::getline(lines, line);) {
    std::vector<std::string>& row = rows.emplace_back();
    std::istringstream cells(line);
    for (std::string cell; std::getline(cells, cell, ',');) row.push_back(cell);
  }
  return rows;
}

// `judges_fd`: false for BLF, where tshark 4.0 shows every frame as a classic one.
inline void expect_as_tshark(const CanLog& ours, const std::string& path, const std::string& folder,
                             bool judges_fd = true) {
  std::size_t next = 0, errors = 0;
  for (const std::vector<std::string>& row : tshark_rows(path, folder)) {
    ASSERT_EQ(row.size(), 10U);
    if (row[4] == "1") {
      ++errors;
      continue;
    }
    ASSERT_LT(next, ours.frames.size());
    const LoggedFrame& logged = ours.frames[next++];
    const can::Frame& f = logged.frame;
    const std::size_t dot = row[0].find('.');
    const std::int64_t at_ns = std::stoll(row[0].substr(0, dot)) * kNanosecondsPerSecond +
                               std::stoll(row[0].substr(dot + 1));
    ASSERT_EQ(logged.at.ns, at_ns) << next;
    ASSERT_EQ(f.id, std::stoul(row[1])) << next;
    ASSERT_EQ(f.extended, row[2] == "1") << next;
    ASSERT_EQ(f.remote, row[3] == "1") << next;
    if (judges_fd) {
      ASSERT_EQ(f.fd, !row[6].empty() || row[9].find("canfd") != std::string::npos) << next;
    }
    ASSERT_EQ(f.length, std::stoul(row[5])) << next;
    if (f.fd && judges_fd) {
      ASSERT_EQ(logged.fd_flags & 3, (row[6] == "1" ? 1 : 0) | (row[7] == "1" ? 2 : 0)) << next;
    }
    if (f.length > 0 && !f.remote) {
      ASSERT_EQ(hex_of(f), row[8]) << next;
    }
  }
  EXPECT_EQ(next, ours.frames.size());
  EXPECT_EQ(errors, ours.counters.error_frames);
}

}  // namespace pitwall::replay::oracle

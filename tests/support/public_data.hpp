// Public recordings outside the source tree: their paths, their sources, and a reader of tables.
//   in      PITWALL_SHARED_DATA, otherwise shared/data beside the source tree
//   use     a test that needs a recording is in a suite Public*, one test per recording, and begins
//           with `if (!is_here(kX)) GTEST_SKIP() << how_to_get(kX);`; tests/public_data counts them
//   docs    docs/public_recordings.md
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

namespace pitwall::recordings {

inline std::filesystem::path folder() {
  if (const char* named = std::getenv("PITWALL_SHARED_DATA")) return named;
  return std::filesystem::path(PITWALL_SOURCE_DIR) / ".." / "shared" / "data";
}

struct Recording {
  const char* path;  // relative to folder(); a file or a folder
  const char* from;  // web address of the source
};

inline constexpr Recording kDatabases{
    "dbc",
    "https://github.com/PITT-MIT-IAC/raptor-dbw-ros2 (raptor_dbw_can/config) and "
    "https://github.com/cantools/cantools (tests/files/dbc, in dbc/corner_cases)"};
// can::fingerprint of CAN1-INDY-V9.dbc, -V12.dbc and -V14.dbc of that source: every id, name,
// length and bit layout of 44, 49 and 47 messages.
inline constexpr std::uint64_t kFingerprintOfV9 = 0xD6C11641CBD19A95;
inline constexpr std::uint64_t kFingerprintOfV12 = 0xD1F3B80FD9B59B9C;
inline constexpr std::uint64_t kFingerprintOfV14 = 0x1D5DCDB7DFDFCA5C;

inline constexpr Recording kNovatelLogs{
    "gnss", "https://github.com/novatel/novatel_oem7_driver (test: align.gps, bestpos.gps)"};
inline constexpr Recording kDrive{
    "laps/Putnam_park2023_run4_2.csv.gz",
    "https://github.com/linklab-uva/deep-dynamics (deep_dynamics/data, then gzip)"};
inline constexpr Recording kLasVegas{
    "tracks/traj_ltpl_cl_LVMS_GPS.csv.gz",
    "https://github.com/TUMFTM/sim_vehicle_dynamics (racetracks, then gzip)"};
inline constexpr Recording kCandump{"can_logs/icsim-sample-can.log",
                                    "https://github.com/zombieCraig/ICSim (data/sample-can.log)"};

inline constexpr Recording kCanLogs{"can_logs",
                                    "https://github.com/hardbyte/python-can (test/data), "
                                    "https://github.com/canboat/canboat (samples) and kCandump's"};

inline constexpr Recording kSpiro{
    "spiro/libspiro_call_test_vectors.json",
    "https://github.com/fontforge/libspiro (tests/call-test.c, its points and figures as JSON)"};

inline std::filesystem::path path_of(const Recording& recording) {
  return folder() / recording.path;
}

inline bool is_here(const Recording& recording) {
  return std::filesystem::exists(path_of(recording));
}

// The reason that a skipped test reports.
inline std::string how_to_get(const Recording& recording) {
  return "wants the public recording " + std::string(recording.path) + " of " + recording.from +
         " in the folder that PITWALL_SHARED_DATA names, which is " + folder().string() +
         " (docs/public_recordings.md)";
}

// Rows of a gzipped table of numbers, without those that begin with '#'; empty if the file is
// missing.
inline std::vector<std::vector<double>> gzipped_table(const std::filesystem::path& path,
                                                      char separator) {
  std::vector<std::vector<double>> rows;
  if (!std::filesystem::exists(path)) return rows;
  FILE* pipe = popen(("zcat '" + path.string() + "'").c_str(), "r");
  if (pipe == nullptr) return rows;
  std::array<char, 1024> line{};
  while (std::fgets(line.data(), line.size(), pipe) != nullptr) {
    if (line[0] == '#') continue;
    std::stringstream fields(line.data());
    std::vector<double>& row = rows.emplace_back();
    for (std::string field; std::getline(fields, field, separator);)
      row.push_back(std::stod(field));
  }
  pclose(pipe);
  return rows;
}

}  // namespace pitwall::recordings

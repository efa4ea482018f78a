// Common inputs of the tests of CAN databases: our own files, the public recorded ones, and noise.
//   errors  our own files must load; the public ones may be missing (empty list)
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "protocol/can/dbc_parser.hpp"
#include "protocol/can/manifest.hpp"
#include "protocol/vocabulary/random.hpp"
#include "tests/support/public_data.hpp"

namespace pitwall::can {

inline const std::filesystem::path kSource{PITWALL_SOURCE_DIR};
inline const std::filesystem::path kOwnDbc = kSource / "protocol/can/dbc/av21.dbc";
inline const std::filesystem::path kOwnManifest = kSource / "protocol/can/dbc/av21.manifest.yaml";

inline std::string text_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  EXPECT_TRUE(file) << path;
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

inline Database load(const std::filesystem::path& path) {
  auto loaded = parse_dbc(text_of(path), path.string());
  if (!loaded) ADD_FAILURE() << to_string(loaded.error());
  return loaded ? *loaded : Database{};
}

inline std::vector<std::filesystem::path> public_files() {
  std::vector<std::filesystem::path> out;
  std::error_code error;
  for (const char* folder : {"dbc", "dbc/corner_cases"}) {
    for (const auto& entry :
         std::filesystem::directory_iterator(recordings::folder() / folder, error)) {
      if (entry.path().extension() == ".dbc") out.push_back(entry.path());
    }
  }
  std::sort(out.begin(), out.end());
  return out;
}

// Invalid public files: a signal outside its message; 29-bit ids without the extended flag.
inline bool is_broken(const std::filesystem::path& path) {
  return path.stem() == "bad_message_length" || path.stem() == "issue_199";
}

inline Frame random_frame(const Message& m, Random& noise) {
  Frame f{.id = m.id,
          .extended = m.extended,
          .remote = false,
          .fd = m.fd,
          .length = static_cast<std::uint8_t>(m.length),
          .data = {}};
  for (std::size_t i = 0; i < m.length; ++i) f.data[i] = static_cast<std::uint8_t>(noise.next());
  return f;
}

// DBC text with one message of `length` bytes that contains these SG_ lines.
inline std::string dbc_with(const std::string& signals, int length = 8) {
  return "VERSION \"\"\nNS_ :\n  CM_\n  BA_\nBS_:\nBU_: A\nBO_ 100 M: " + std::to_string(length) +
         " A\n" + signals + "\n";
}

// A valid signal line for dbc_with().
inline const std::string kSignal = " SG_ a : 0|8@1+ (1,0) [0|0] \"\" A\n";

inline std::string complaint(const std::string& text) {
  const auto parsed = parse_dbc(text, "t.dbc");
  return parsed ? "" : to_string(parsed.error());
}

inline Database leniently(const std::string& text, const std::string& name = "t.dbc") {
  auto result = parse_dbc_leniently(text, name);
  if (!result) ADD_FAILURE() << to_string(result.error());
  return result ? *result : Database{};
}

// Every error of a lenient parse, worst first, one per line.
inline std::string errors_of(const Database& d) {
  std::string out;
  for (const Finding* const f : worst_first(d)) {
    if (severity_of(f->kind) == FindingSeverity::kError) {
      out += f->place + ": " + text_of(*f) + "\n";
    }
  }
  return out;
}

inline std::size_t signals_of(const Database& d) {
  std::size_t count = 0;
  for (const Message& m : d.messages) count += m.signals.size();
  return count;
}

inline Database parsed(const std::string& text) {
  auto result = parse_dbc(text, "t.dbc");
  if (!result) ADD_FAILURE() << to_string(result.error());
  return result ? *result : Database{};
}

}  // namespace pitwall::can

// Samples for the tests of this folder: a black box in memory, files written by other programs, and
// recordings as lines in the form of tests/support/oracles/bag_line.mjs.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

#include "hil/replay/recordings/recording.hpp"
#include "protocol/gnss/novatel_codec.hpp"
#include "protocol/gnss/vectornav_codec.hpp"
#include "protocol/recorder/can_record.hpp"
#include "protocol/recorder/channels.hpp"
#include "protocol/recorder/raw_record.hpp"
#include "protocol/vocabulary/bytes.hpp"
#include "tests/support/oracle_node.hpp"

namespace pitwall::traffic::testing {

inline constexpr std::int64_t kStart_ns = 1'700'000'000'000'000'000;

inline std::string digits_of(Bytes bytes) {
  std::string text;
  for (const std::uint8_t byte : bytes) {
    text += "0123456789abcdef"[byte / 16];
    text += "0123456789abcdef"[byte % 16];
  }
  return text;
}

inline std::string line_of(const Recording& recording, const Record& record) {
  std::ostringstream text;
  text << recording.sources[record.source].name << " " << record.at.ns << " ";
  const can::Frame* frame = record.frame();
  if (frame == nullptr) {
    text << digits_of(record.bytes()) << "\n";
    return text.str();
  }
  text << "can " << std::hex << frame->id << std::dec << " " << frame->extended << frame->remote
       << frame->fd << " " << int{frame->length} << " "
       << (frame->remote ? "" : digits_of(frame->payload())) << "\n";
  return text.str();
}

inline std::vector<std::string> sorted_lines(const Recording& recording) {
  std::vector<std::string> lines;
  for (const Record& record : recording.records) lines.push_back(line_of(recording, record));
  std::ranges::sort(lines);
  return lines;
}

inline std::vector<std::string> sorted_lines(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream{text};
  for (std::string line; std::getline(stream, line);) lines.push_back(line + "\n");
  std::ranges::sort(lines);
  return lines;
}

inline std::string all_remarks(const Recording& recording) {
  std::string text;
  for (const Remark& remark : recording.remarks) text += to_string(remark) + "\n";
  return text;
}

// Checks every invariant of recording.hpp.
inline void expect_sound(const Recording& recording) {
  EXPECT_TRUE(std::ranges::is_sorted(recording.records, precedes));
  std::vector<Source> seen = recording.sources;
  for (Source& source : seen) source.records = 0;
  for (const Record& record : recording.records) {
    ASSERT_LT(record.source, seen.size());
    Source& source = seen[record.source];
    EXPECT_EQ(source.kind == SourceKind::kCan, record.frame() != nullptr);
    EXPECT_LT(record.sequence, recording.sources[record.source].records);
    EXPECT_GE(record.at, source.first);
    EXPECT_LE(record.at, source.last);
    ++source.records;
    for (const std::uint8_t byte : record.bytes()) EXPECT_LE(byte, 255);  // reads every byte
  }
  EXPECT_EQ(seen, recording.sources);
}

struct ByteSink {
  std::string bytes;

  recording::Sink sink() {
    return [this](Bytes more) {
      bytes.append(reinterpret_cast<const char*>(more.data()), more.size());
      return true;
    };
  }
};

inline std::string novatel_position(std::uint16_t week, std::uint32_t milliseconds) {
  gnss::BestPos position;
  position.latitude_deg = 36.27, position.longitude_deg = -115.01, position.height_m = 594.0;
  std::array<std::uint8_t, gnss::kMaxEncodedBytes> bytes{};
  gnss::NovatelHeader header;
  header.week = week;
  header.milliseconds = milliseconds;
  const std::size_t n = gnss::encode(header, position, bytes);
  return {bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(n)};
}

inline can::Frame some_frame(std::uint32_t i) {
  can::Frame frame{.id = i % 5 == 4 ? 0x18DA'F110U + i : i % 0x7FF,
                   .extended = i % 5 == 4,
                   .remote = i % 7 == 3,
                   .fd = false,
                   .length = static_cast<std::uint8_t>(i % 9)};
  if (!frame.remote)
    for (std::size_t k = 0; k < frame.length; ++k)
      frame.data[k] = static_cast<std::uint8_t>(i + 31 * k);
  return frame;
}

// Received and sent frames, bytes of a receiver, a state and a text, every 10 ms.
inline std::string black_box(std::uint32_t steps) {
  ByteSink file;
  recording::McapWriter writer{recorder::channels(),
                               {{"program", "test"}},
                               file.sink(),
                               {.messages_per_chunk = 64, .chunk_span = seconds(1)}};
  for (std::uint32_t i = 0; i < steps; ++i) {
    const Instant at{kStart_ns + std::int64_t{i} * 10'000'000};
    recorder::CanBytes buffer;
    for (const std::uint16_t channel : {recorder::kCanOutChannel, recorder::kCanInChannel}) {
      const can::Frame frame = some_frame(2 * i + channel % 2);
      EXPECT_TRUE(writer.write({channel}, at, recorder::encode(frame, buffer)));
    }
    const std::string gnss = novatel_position(2'297, 172'800'000 + 10 * i);
    EXPECT_TRUE(writer.write({recorder::kReceiverChannel}, at, as_bytes(gnss)));
    const auto state = recorder::encode(telemetry::Group::kEgo, telemetry::Values{});
    EXPECT_TRUE(writer.write({recorder::channel_of(telemetry::Group::kEgo)}, at, state.span()));
    EXPECT_TRUE(writer.write({recorder::channel_of(recorder::Topic::kEvent)}, at,
                             as_bytes(R"({"type":"event"})")));
  }
  EXPECT_TRUE(writer.close());
  return file.bytes;
}

// A path that only this process uses, because tests run in parallel.
inline std::string scratch(const std::string& name) {
  const std::string own = "pitwall_recordings_" + std::to_string(::getpid()) + "_" + name;
  return (std::filesystem::path{::testing::TempDir()} / own).string();
}

inline std::string bytes_of(const std::string& path) {
  std::ifstream stream{path, std::ios::binary};
  return {std::istreambuf_iterator<char>{stream}, {}};
}

inline void write_bytes(const std::string& path, const std::string& bytes) {
  std::ofstream{path, std::ios::binary}.write(bytes.data(),
                                              static_cast<std::streamsize>(bytes.size()));
}

// Writes a bag by another program (write_bag.mjs) and returns its path.
inline std::string bag_mcap(const std::string& compression, int chunk_bytes, int count) {
  const std::string path = scratch(compression + ".mcap");
  pitwall::testing::node("write_bag.mjs", "'" + path + "' " + compression + " " +
                                              std::to_string(chunk_bytes) + " " +
                                              std::to_string(count));
  return path;
}

inline std::string bag_db3(const std::string& name, int count, const std::string& messages = "",
                           const std::string& options = "") {
  using pitwall::testing::kOracles;
  const std::string path = scratch(name + ".db3");
  std::filesystem::remove(path);
  const std::string lines = pitwall::testing::node(
      "bag_messages.mjs", std::to_string(count) + " " + messages + " | python3 '" +
                              (kOracles / "write_db3.py").string() + "' '" + path + "' " + options);
  EXPECT_EQ(lines, "");
  return path;
}

inline std::string oracle_lines_of_db3(const std::string& path) {
  using pitwall::testing::kOracles;
  return pitwall::testing::output_of("python3 '" + (kOracles / "read_db3.py").string() + "' '" +
                                     path + "' | '" +
                                     (kOracles / "node_modules/.bin/node").string() + "' '" +
                                     (kOracles / "say_bag_lines.mjs").string() + "'");
}

// Pseudo-random numbers, the same on every machine.
class Dice {
 public:
  explicit Dice(std::uint32_t seed) : state_(seed) {}
  std::size_t below(std::size_t most) {
    state_ = state_ * 1'664'525U + 1'013'904'223U;  // Numerical Recipes, ranqd1
    return static_cast<std::size_t>(state_ >> 8) % most;
  }

 private:
  std::uint32_t state_;
};

// One kind of damage: some bytes changed, removed or inserted, or the end cut off.
inline std::string damaged(std::string file, Dice& dice) {
  const std::size_t at = dice.below(file.size());
  const std::size_t count = 1 + dice.below(16);
  switch (dice.below(4)) {
    case 0:
      for (std::size_t i = at; i < std::min(at + count, file.size()); ++i)
        file[i] = static_cast<char>(file[i] ^ static_cast<char>(1 + dice.below(255)));
      break;
    case 1:
      file.erase(at, count);
      break;
    case 2:
      file.insert(at, count, static_cast<char>(dice.below(256)));
      break;
    default:
      file.resize(at);
  }
  return file;
}

}  // namespace pitwall::traffic::testing

// Our MCAP files and @mcap/core's are read by each other: every value, time and CRC.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>

#include "protocol/recording/mcap_reader.hpp"
#include "protocol/recording/mcap_writer.hpp"
#include "tests/protocol/recording/mcap_samples.hpp"
#include "tests/support/oracle_node.hpp"

namespace pitwall::recording {
namespace {

using pitwall::testing::node;

std::string scratch_file(const std::string& name) {
  return (std::filesystem::path{::testing::TempDir()} / ("pitwall_oracle_" + name)).string();
}

std::string hex(std::span<const std::uint8_t> bytes) {
  std::string text;
  std::array<char, 3> digits{};
  for (const std::uint8_t byte : bytes) {
    std::snprintf(digits.data(), digits.size(), "%02x", unsigned{byte});
    text += digits.data();
  }
  return text;
}

std::string hex_of(double v) {
  std::array<std::uint8_t, 8> bytes{};
  const auto bits = std::bit_cast<std::uint64_t>(v);
  for (std::size_t i = 0; i < 8; ++i) bytes[i] = static_cast<std::uint8_t>(bits >> (56 - 8 * i));
  return hex(bytes);
}

// As mcap_line.mjs writes it.
std::string values(const testing::Sample& s) {
  std::ostringstream text;
  text << "mode=" << hex_of(s.mode) << " speed_mps=" << hex_of(s.speed_mps)
       << " armed=" << (s.armed ? "true" : "false") << " gear=" << hex_of(s.gear)
       << " frames=" << hex_of(s.frames) << " share=" << hex_of(double{s.share})
       << " raw=" << hex(s.raw.span()) << " at_ns=" << s.at_ns << " delta=" << hex_of(s.delta)
       << " total=" << s.total;
  return text.str();
}

struct Line {
  std::int64_t at_ns;
  std::string text;
};

std::string joined(const std::vector<Line>& lines) {
  std::string text;
  for (const Line& line : lines) text += line.text + "\n";
  return text;
}

TEST(McapOracle, ReadsEveryValueOfOurFile) {
  NEEDS_ORACLES();
  testing::MemoryFile file;
  McapWriter writer{{cdr_channel<testing::Sample>("/sample"),
                     {"/words", "json", {}, {{"note", "no schema"}}},
                     cdr_channel<testing::Sample>("/again")},
                    {{"scenario", "oracle"}, {"seed", "1"}},
                    file.sink(),
                    {.chunk_bytes = 2048, .messages_per_chunk = 64, .chunk_span = seconds(1)}};
  std::vector<Line> lines;
  std::array<std::uint32_t, 3> sequences{};
  for (std::uint32_t i = 0; i < 600; ++i) {
    const std::uint16_t channel = static_cast<std::uint16_t>(i * i % 3);
    // Every seventh message is late; times repeat.
    const Instant at{std::int64_t{i / 2} * 10'000'000 - (i % 7 == 6 ? 25'000'000 : 0)};
    const Instant published{at.ns + 5};
    std::array<std::uint8_t, cdr_bytes_max<testing::Sample>()> buffer;
    const std::array<std::uint8_t, 2> words{'{', '}'};
    const std::string head = " " + std::to_string(sequences[channel]++) + " " +
                             std::to_string(at.ns) + " " + std::to_string(published.ns) + " ";
    if (channel == 1) {
      ASSERT_TRUE(writer.write({channel}, at, published, words));
      lines.push_back({at.ns, "/words" + head + hex(words)});
    } else {
      const testing::Sample s = testing::sample(i);
      ASSERT_TRUE(writer.write({channel}, at, published, to_cdr(s, std::span{buffer})));
      lines.push_back({at.ns, (channel == 0 ? "/sample" : "/again") + head + values(s)});
    }
  }
  ASSERT_TRUE(writer.close());
  ASSERT_GT(writer.counters().chunks, 10U);
  const std::string path = scratch_file("ours.mcap");
  std::ofstream{path, std::ios::binary}.write(reinterpret_cast<const char*>(file.bytes.data()),
                                              static_cast<std::streamsize>(file.bytes.size()));

  std::string expected = "stream\n" + joined(lines) + "indexed\n";
  std::ranges::stable_sort(lines, {}, &Line::at_ns);
  expected += joined(lines);
  const auto chunks = std::to_string(writer.counters().chunks);
  expected += "statistics 600 1 3 " + chunks + " 1 " + std::to_string(lines.front().at_ns) + " " +
              std::to_string(lines.back().at_ns) + "\nrun scenario=oracle seed=1\n";
  EXPECT_EQ(node("read_mcap.mjs", "'" + path + "'"), expected);
}

TEST(McapOracle, OurReaderReadsItsFiles) {
  NEEDS_ORACLES();
  for (const std::string chunk_bytes : {"0", "700", "1000000"}) {
    const std::string path = scratch_file("theirs_" + chunk_bytes + ".mcap");
    const std::string expected = node("write_mcap.mjs", "'" + path + "' " + chunk_bytes);
    std::ifstream stream{path, std::ios::binary};
    const std::vector<char> raw{std::istreambuf_iterator<char>{stream}, {}};
    const std::vector<std::uint8_t> bytes(raw.begin(), raw.end());

    McapReader reader{bytes};
    std::ostringstream got;
    while (const auto m = reader.next()) {
      const Channel& channel = reader.channels().at(m->channel);
      EXPECT_EQ(channel.schema.name, "Any");
      EXPECT_EQ(channel.metadata, (Metadata{{"k", channel.topic}}));
      got << channel.topic << " " << m->sequence << " " << m->logged_ns << " " << m->published_ns
          << " " << hex(m->data) << "\n";
    }
    EXPECT_EQ(got.str(), expected) << chunk_bytes;
    EXPECT_EQ(reader.end(), McapEnd::kComplete);
    EXPECT_EQ(reader.run(), (Metadata{{"seed", "7"}}));
    const McapReaderCounters& counters = reader.counters();
    EXPECT_EQ(counters.messages, 500U);
    EXPECT_EQ(counters.unverified, chunk_bytes == "0" ? 500U : 0U);
    EXPECT_EQ(counters.bad_chunk_crc + counters.bad_data_crc + counters.bad_summary_crc, 0U);
  }
}

}  // namespace
}  // namespace pitwall::recording

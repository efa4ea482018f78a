// SPDX-License-Identifier: Apache-2.0
// A second implementation in Python (receiver_oracle.py: struct, zlib, binascii) as a judge of what
// we write: both forms of every NovAtel log, and VectorNav messages of all fields.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "protocol/gnss/novatel_ascii.hpp"
#include "protocol/gnss/novatel_codec.hpp"
#include "tests/protocol/gnss/random_messages.hpp"

namespace pitwall::gnss {
namespace {

constexpr const char* kPython = "/usr/bin/python3";

bool has_python() { return std::filesystem::exists(kPython); }

std::string hex(std::span<const std::uint8_t> bytes) {
  std::string text;
  for (const std::uint8_t b : bytes) {
    text += "0123456789abcdef"[b >> 4U];
    text += "0123456789abcdef"[b & 15U];
  }
  return text;
}

std::vector<std::string> judged(const std::string& messages) {
  const auto file = std::filesystem::path(::testing::TempDir()) /
                    ("receivers_" + std::to_string(getpid()) + ".txt");
  std::ofstream(file) << messages;
  const std::string script =
      std::string(PITWALL_SOURCE_DIR) + "/tests/protocol/gnss/receiver_oracle.py";
  FILE* const pipe =
      popen((std::string(kPython) + " '" + script + "' < '" + file.string() + "'").c_str(), "r");
  std::vector<std::string> lines;
  if (pipe == nullptr) return lines;
  char* line = nullptr;
  std::size_t room = 0;
  for (ssize_t n = getline(&line, &room, pipe); n > 0; n = getline(&line, &room, pipe)) {
    lines.emplace_back(line, static_cast<std::size_t>(n - 1));
  }
  std::free(line);
  EXPECT_EQ(pclose(pipe), 0);
  std::filesystem::remove(file);
  return lines;
}

TEST(ReceiverOracle, ReadsBothFormsOfEveryNovatelLogAsWeMeanThem) {
  ASSERT_TRUE(has_python()) << "no " << kPython << " (./pitwall setup)";
  std::mt19937_64 random{93};
  std::string messages;
  constexpr std::size_t kMessages = 3'600;
  std::array<std::uint8_t, kMaxEncodedBytes> binary{};
  std::array<std::uint8_t, kMaxAsciiBytes> ascii{};
  for (std::size_t i = 0; i < kMessages; ++i) {
    const NovatelMessage message = random_message(i % kLogs, random);
    const NovatelHeader header = random_header(random);
    const std::size_t n = encode(header, message, binary);
    messages += "N " + hex(std::span{binary}.first(n)) + " ";
    messages += hex(std::span{ascii}.first(encode_ascii(header, message, ascii))) + "\n";
  }
  const auto lines = judged(messages);
  ASSERT_EQ(lines.size(), kMessages);
  for (const std::string& line : lines) EXPECT_EQ(line.substr(0, 3), "ok ") << line;
}

// All values of a message in the order in which they are sent, floats as their bits.
struct Printer {
  std::uint32_t mask = 0;
  std::string text;

  template <class... Field>
  void operator()(unsigned bit, Kind, const Field&... field) {
    if ((mask >> bit & 1U) != 0) (print(field), ...);
  }
  void skip(unsigned, std::size_t) {}

 private:
  template <class T, std::size_t N>
  void print(const std::array<T, N>& values) {
    for (const T value : values) print(value);
  }
  void print(float value) { text += " " + std::to_string(std::bit_cast<std::uint32_t>(value)); }
  void print(double value) { text += " " + std::to_string(std::bit_cast<std::uint64_t>(value)); }
  template <class T>
  requires std::is_integral_v<T>
  void print(T value) { text += " " + std::to_string(value); }
};

TEST(ReceiverOracle, ReadsVectorNavMessagesAsWeMeanThem) {
  ASSERT_TRUE(has_python()) << "no " << kPython << " (./pitwall setup)";
  std::mt19937_64 random{310};
  std::string messages;
  std::vector<std::string> expected;
  std::array<std::uint8_t, kMaxVectorNavBytes> bytes{};
  for (int i = 0; i < 1'000; ++i) {
    const VectorNavMessage message = random_vectornav(random_output(random), random);
    messages += "V " + hex(std::span{bytes}.first(encode(message, bytes))) + "\n";
    Printer printer;
    for (std::size_t group = 0; group < kVectorNavGroups; ++group) {
      printer.mask = message.output.fields[group];
      visit_fields(static_cast<VectorNavGroup>(group), message, printer);
    }
    expected.push_back("ok" + printer.text);
  }
  EXPECT_EQ(judged(messages), expected);
}

}  // namespace
}  // namespace pitwall::gnss

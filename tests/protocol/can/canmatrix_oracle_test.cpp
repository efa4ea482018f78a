// SPDX-License-Identifier: Apache-2.0
// Every value that canmatrix (Debian's python3-canmatrix) decodes from random payloads of every
// database at hand must be the one that we decode; and its layouts must be ours.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <sstream>

#include "protocol/can/decode.hpp"
#include "tests/protocol/can/dbc_files.hpp"

namespace pitwall::can {
namespace {

constexpr int kPayloadsPerMessage = 200;
constexpr const char* kPython = "/usr/bin/python3";

bool has_canmatrix() {
  return std::system((std::string(kPython) + " -c 'import canmatrix' >/dev/null 2>&1").c_str()) ==
         0;
}

std::string hex(const Frame& f) {
  std::string out;
  for (const std::uint8_t b : f.payload()) {
    constexpr const char* kDigits = "0123456789abcdef";
    out += kDigits[b >> 4U];
    out += kDigits[b & 15U];
  }
  return out;
}

// Mostly random; half of the multiplexed ones get a selector that has signals.
std::vector<std::pair<const Message*, Frame>> traffic(const Database& d, Noise& noise) {
  std::vector<std::pair<const Message*, Frame>> out;
  for (const Message& m : d.messages) {
    for (int i = 0; i < kPayloadsPerMessage; ++i) {
      Frame f = random_frame(m, noise);
      for (const Signal& s : m.signals) {
        if (!s.selector || noise.below(2) == 0 || noise.below(m.signals.size()) > 2) continue;
        insert(m.signals[*s.selector].plan, f.data, s.when[noise.below(s.when.size())].low);
      }
      out.emplace_back(&m, f);
    }
  }
  return out;
}

std::vector<std::string> ask_canmatrix(const std::filesystem::path& dbc, const std::string& input) {
  const auto folder = std::filesystem::path(testing::TempDir());
  const auto file = folder / ("frames_" + dbc.stem().string() + ".txt");
  std::ofstream(file) << input;
  const auto script = kSource / "tests/protocol/can/canmatrix_oracle.py";
  const std::string command = std::string(kPython) + " '" + script.string() + "' '" + dbc.string() +
                              "' < '" + file.string() + "' 2>/dev/null";
  std::vector<std::string> lines;
  FILE* const pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) return lines;
  std::string line;
  for (int c = std::fgetc(pipe); c != EOF; c = std::fgetc(pipe)) {
    if (c != '\n') {
      line += static_cast<char>(c);
      continue;
    }
    lines.push_back(line);
    line.clear();
  }
  EXPECT_EQ(pclose(pipe), 0) << dbc;
  std::filesystem::remove(file);
  return lines;
}

void expect_same_layout(const Database& d, const std::string& line) {
  std::istringstream in(line);
  std::string tag, name;
  std::uint32_t id = 0;
  unsigned extended = 0, bytes = 0, start = 0, length = 0, intel = 0, is_signed = 0, is_float = 0;
  double scale = 0, offset = 0;
  in >> tag >> id >> extended >> bytes >> name >> start >> length >> intel >> is_signed >>
      is_float >> scale >> offset;
  const Message* const m = d.find(id, extended != 0);
  ASSERT_NE(m, nullptr) << line;
  EXPECT_EQ(m->length, bytes) << line;
  const Signal* const s = m->find(name);
  ASSERT_NE(s, nullptr) << line;
  const SignalLayout& l = s->layout;
  EXPECT_EQ(l.start, start) << line;
  EXPECT_EQ(l.length, length) << line;
  EXPECT_EQ(l.order == ByteOrder::kIntel, intel != 0) << line;
  EXPECT_EQ(l.number == Number::kFloat32 || l.number == Number::kFloat64, is_float != 0) << line;
  EXPECT_TRUE(is_float != 0 || (l.number == Number::kSigned) == (is_signed != 0)) << line;
  EXPECT_EQ(l.scale, scale) << line;
  EXPECT_EQ(l.offset, offset) << line;
}

struct Tally {
  int values = 0, frames_refused = 0;
};

void expect_same_values(const Message& m, const Frame& f, const std::string& line, Tally& tally) {
  std::vector<double> values(m.signals.size());
  ASSERT_TRUE(decode(m, f, values)) << m.name;
  std::istringstream in(line.substr(1));
  std::string pair;
  std::size_t present = 0;
  while (in >> pair) {
    const std::size_t equals = pair.find('=');
    const auto i = m.index_of(pair.substr(0, equals));
    ASSERT_TRUE(i.has_value()) << m.name << " " << pair;
    const double theirs = std::strtod(pair.c_str() + equals + 1, nullptr);
    const double ours = values[*i];
    const double tolerance =
        1e-12 * std::max(std::abs(theirs), std::abs(m.signals[*i].plan.offset));
    const bool both_nan = std::isnan(theirs) && std::isnan(ours);
    EXPECT_TRUE(both_nan || ours == theirs || std::abs(ours - theirs) <= tolerance)
        << m.name << " " << pair << " ours " << ours << " payload " << hex(f);
    ++tally.values;
    ++present;
  }
  std::size_t ours_present = 0;
  for (const Signal& s : m.signals) ours_present += is_present(m, s, f) ? 1U : 0U;
  EXPECT_EQ(present, ours_present) << m.name << " payload " << hex(f) << line;
}

void compare(const std::filesystem::path& path, const Database& d, Tally& tally) {
  Noise noise{fingerprint(d)};
  const auto frames = traffic(d, noise);
  std::ostringstream input;
  for (const auto& [m, f] : frames) input << m->id << " " << m->extended << " " << hex(f) << "\n";
  std::size_t signals = 0, layouts = 0, at = 0;
  for (const Message& m : d.messages) signals += m.signals.size();
  for (const std::string& line : ask_canmatrix(path, input.str())) {
    if (line.starts_with("L ")) {
      expect_same_layout(d, line);
      ++layouts;
      continue;
    }
    ASSERT_LT(at, frames.size());
    const auto& [m, f] = frames[at++];
    if (line == "E") {
      ++tally.frames_refused;
    } else {
      expect_same_values(*m, f, line, tally);
    }
  }
  EXPECT_EQ(layouts, signals) << path;
  EXPECT_EQ(at, frames.size()) << path;
}

TEST(CanmatrixOracle, SameLayoutsAndValues) {
  ASSERT_TRUE(has_canmatrix()) << kPython << " has no canmatrix (python3-canmatrix)";
  auto files = public_files();
  files.push_back(kOwnDbc);
  Tally tally;
  for (const auto& path : files) {
    if (is_broken(path)) continue;  // refused by us, on purpose
    compare(path, load(path), tally);
  }
  std::printf("%d values of %zu files compared; canmatrix refused %d frames\n", tally.values,
              files.size(), tally.frames_refused);
  EXPECT_GT(tally.values, 179 * kPayloadsPerMessage / 2);
}

}  // namespace
}  // namespace pitwall::can

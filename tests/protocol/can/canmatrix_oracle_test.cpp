// SPDX-License-Identifier: Apache-2.0
// canmatrix (Debian's python3-canmatrix) as a judge: every value that it decodes from random
// payloads of every database at hand must be the one that we decode; what it decodes from frames
// that we encoded must be the value that was asked for, rounded and saturated; and its layouts must
// be ours. PITWALL_ORACLE_PAYLOADS raises the number of payloads of each message.
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>
#include <map>
#include <sstream>
#include <unordered_map>

#include "protocol/can/decode.hpp"
#include "protocol/can/encode.hpp"
#include "tests/protocol/can/dbc_files.hpp"
#include "tests/protocol/can/oracle_payloads.hpp"

namespace pitwall::can {
namespace {

constexpr std::uint64_t kPayloadsPerMessage = 100;
constexpr std::uint64_t kEncodedPart = 4;  // one frame in so many is encoded by us
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

// One frame, and what every present signal of it must say.
struct Sample {
  Frame frame;
  std::vector<double> expected;
};

// Mostly random; half of the multiplexed ones get a selector that has signals.
Sample random_sample(const Message& m, Random& noise) {
  Sample out{random_frame(m, noise), std::vector<double>(m.signals.size())};
  for (const Signal& s : m.signals) {
    if (!s.selector || noise.below(2) == 0 || noise.below(m.signals.size()) > 2) continue;
    insert(m.signals[*s.selector].plan, out.frame.data, s.when[noise.below(s.when.size())].low);
  }
  EXPECT_TRUE(decode(m, out.frame, out.expected)) << m.name;
  return out;
}

struct Asked {
  double value = 0.0, expected = 0.0;
};

// A whole number of steps, some of them outside the field, and a part of a step that rounding takes
// away again: what must arrive is known without any division of the value.
Asked whole_value(const Signal& s, Random& noise) {
  const SignalLayout& l = s.layout;
  const bool is_signed = l.number == Number::kSigned;
  const double span = std::ldexp(1.0, l.length);
  double low = is_signed ? -span / 2 : 0.0, high = (is_signed ? span / 2 : span) - 1.0;
  if (l.min < l.max) {
    const double a = (l.min - l.offset) / l.scale, b = (l.max - l.offset) / l.scale;
    const double least = std::ceil(std::min(a, b) - 1e-6);
    const double most = std::floor(std::max(a, b) + 1e-6);
    const double tight_low = std::max(low, least), tight_high = std::min(high, most);
    if (tight_low <= tight_high) low = tight_low, high = tight_high;
  }
  const double unit = static_cast<double>(noise.next() >> 11U) * 0x1.0p-53;
  const double steps = std::round(low + (1.5 * unit - 0.25) * (high - low + 4.0));
  constexpr std::array<double, 5> kParts{0.0, 0.25, -0.25, 0.45, -0.45};
  const double part = l.length > 32 ? 0.0 : kParts[noise.below(kParts.size())];
  const double arrives = std::min(std::max(steps, low), high);
  return {l.offset + l.scale * (steps + part), l.offset + l.scale * arrives};
}

Asked real_value(const Signal& s, Random& noise) {
  const SignalLayout& l = s.layout;
  const double mantissa = static_cast<double>(noise.below(2'000'001)) - 1e6;
  const double value = std::ldexp(mantissa, static_cast<int>(noise.below(60)) - 40);
  double number = (value - l.offset) / l.scale;
  if (l.min < l.max) {
    const double a = (l.min - l.offset) / l.scale, b = (l.max - l.offset) / l.scale;
    number = std::min(std::max(number, std::min(a, b)), std::max(a, b));
  }
  if (l.number == Number::kFloat32) number = static_cast<double>(static_cast<float>(number));
  return {value, number * l.scale + l.offset};
}

Sample encoded_sample(const Message& m, Random& noise) {
  std::vector<double> values;
  Sample out;
  for (const Signal& s : m.signals) {
    const bool is_real = s.layout.number == Number::kFloat32 || s.layout.number == Number::kFloat64;
    const Asked asked = is_real ? real_value(s, noise) : whole_value(s, noise);
    values.push_back(asked.value);
    out.expected.push_back(asked.expected);
  }
  for (const Signal& s : m.signals) {  // selectors that choose something
    if (!s.selector || noise.below(2) == 0) continue;
    const SignalLayout& l = m.signals[*s.selector].layout;
    const double low = static_cast<double>(s.when[noise.below(s.when.size())].low);
    if (low >= std::ldexp(1.0, l.length - 1)) continue;
    values[*s.selector] = out.expected[*s.selector] = low * l.scale + l.offset;
  }
  EncodeCounters counters;
  EXPECT_TRUE(encode(m, values, out.frame, counters)) << m.name;
  return out;
}

// Calls fn for each line that canmatrix says of these frames.
void ask_canmatrix(const std::filesystem::path& dbc, const std::string& input,
                   const std::function<void(std::string_view)>& fn) {
  const auto folder = std::filesystem::path(testing::TempDir());
  const auto file = folder / ("frames_" + std::to_string(getpid()) + dbc.stem().string() + ".txt");
  std::ofstream(file) << input;
  const auto script = kSource / "tests/protocol/can/canmatrix_oracle.py";
  const std::string command = std::string(kPython) + " '" + script.string() + "' '" + dbc.string() +
                              "' < '" + file.string() + "' 2>/dev/null";
  FILE* const pipe = popen(command.c_str(), "r");
  ASSERT_NE(pipe, nullptr);
  char* line = nullptr;
  std::size_t room = 0;
  for (ssize_t n = getline(&line, &room, pipe); n > 0; n = getline(&line, &room, pipe)) {
    fn(std::string_view{line, static_cast<std::size_t>(n - 1)});
  }
  std::free(line);
  EXPECT_EQ(pclose(pipe), 0) << dbc;
  std::filesystem::remove(file);
}

// A line of the oracle; names of signals may hold spaces.
struct OracleLayout {
  std::uint32_t id = 0;
  bool is_extended = false, is_intel = false, is_signed = false, is_float = false;
  unsigned bytes = 0, start = 0, length = 0;
  double scale = 0, offset = 0;
  std::string name;
};

OracleLayout layout_of(const std::string& line) {
  std::istringstream in(line);
  std::string tag;
  OracleLayout o;
  in >> tag >> o.id >> o.is_extended >> o.bytes >> o.start >> o.length >> o.is_intel >>
      o.is_signed >> o.is_float >> o.scale >> o.offset >> std::ws;
  std::getline(in, o.name);
  return o;
}

void expect_same_layout(const Database& d, const std::string& line) {
  const OracleLayout o = layout_of(line);
  const Message* const m = d.find(o.id, o.is_extended);
  ASSERT_NE(m, nullptr) << line;
  EXPECT_EQ(m->length, o.bytes) << line;
  const Signal* const s = m->find(o.name);
  ASSERT_NE(s, nullptr) << line;
  const SignalLayout& l = s->layout;
  EXPECT_EQ(l.start, o.start) << line;
  EXPECT_EQ(l.length, o.length) << line;
  EXPECT_EQ(l.order == ByteOrder::kIntel, o.is_intel) << line;
  EXPECT_EQ(l.number == Number::kFloat32 || l.number == Number::kFloat64, o.is_float) << line;
  EXPECT_TRUE(o.is_float || (l.number == Number::kSigned) == o.is_signed) << line;
  EXPECT_EQ(l.scale, o.scale) << line;
  EXPECT_EQ(l.offset, o.offset) << line;
}

struct OracleTally {
  std::uint64_t frames = 0, values = 0, mismatches = 0;
  std::map<std::string, std::uint64_t> refused;  // by message and reason
};

bool is_same(double ours, double theirs, const Signal& s) {
  const double tolerance = 1e-12 * std::max(std::abs(theirs), std::abs(s.layout.offset));
  return (std::isnan(theirs) && std::isnan(ours)) || ours == theirs ||
         std::abs(ours - theirs) <= tolerance;
}

using NameIndex = std::unordered_map<std::string_view, std::size_t>;

void expect_same_values(const Message& m, const NameIndex& names, const Sample& sample,
                        std::string_view line, OracleTally& tally) {
  std::size_t present = 0;
  for (std::size_t at = 1; at < line.size();) {
    const std::size_t equals = line.find('=', at);
    if (equals == std::string_view::npos) break;
    const std::size_t end = std::min(line.find(' ', equals), line.size());
    const auto i = names.find(line.substr(at + 1, equals - at - 1));
    ASSERT_NE(i, names.end()) << m.name << " " << line;
    const double theirs =
        std::strtod(std::string{line.substr(equals + 1, end - equals - 1)}.c_str(), nullptr);
    const double ours = sample.expected[i->second];
    if (!is_same(ours, theirs, m.signals[i->second]) && ++tally.mismatches <= 20) {
      ADD_FAILURE() << m.name << "." << i->first << " ours " << ours << " theirs " << theirs
                    << " payload " << hex(sample.frame);
    }
    ++tally.values;
    ++present;
    at = end;
  }
  std::size_t ours_present = 0;
  for (const Signal& s : m.signals) ours_present += is_present(m, s, sample.frame) ? 1U : 0U;
  if (present != ours_present && ++tally.mismatches <= 20) {
    ADD_FAILURE() << m.name << " payload " << hex(sample.frame) << " " << line;
  }
}

// Few messages at a time, so that the frames of a large file need little memory.
void compare(const std::filesystem::path& path, const Database& d, std::span<const Message> part,
             OracleTally& tally) {
  Random noise{fingerprint(d) + part.front().id};
  const std::uint64_t payloads = oracle_payloads(kPayloadsPerMessage);
  std::vector<Sample> samples;
  std::vector<NameIndex> names(part.size());
  std::string input;
  std::size_t signals = 0, layouts = 0, at = 0;
  for (const Message& m : d.messages) signals += m.signals.size();
  for (std::size_t k = 0; k < part.size(); ++k) {
    const Message& m = part[k];
    for (std::size_t i = 0; i < m.signals.size(); ++i) names[k][m.signals[i].name] = i;
    for (std::uint64_t i = 0; i < payloads; ++i) {
      samples.push_back(i % kEncodedPart == 0 ? encoded_sample(m, noise) : random_sample(m, noise));
      input +=
          std::to_string(m.id) + (m.extended ? " 1 " : " 0 ") + hex(samples.back().frame) + "\n";
    }
  }
  ask_canmatrix(path, input, [&](std::string_view line) {
    if (line.starts_with("L ")) {
      expect_same_layout(d, std::string{line});
      ++layouts;
      return;
    }
    ASSERT_LT(at, samples.size());
    const std::size_t k = at / payloads;
    const Sample& sample = samples[at++];
    if (line.starts_with("E")) {
      ++tally.refused[part[k].name + ": " + std::string{line.substr(1)}];
    } else {
      expect_same_values(part[k], names[k], sample, line, tally);
    }
  });
  EXPECT_EQ(layouts, signals) << path;
  EXPECT_EQ(at, samples.size()) << path;
  tally.frames += samples.size();
}

TEST(CanmatrixOracle, SameLayoutsAndValues) {
  ASSERT_TRUE(has_canmatrix()) << kPython << " has no canmatrix (python3-canmatrix)";
  constexpr std::uint64_t kFramesAtOnce = 1'000'000;
  const std::size_t at_once =
      std::max<std::uint64_t>(1, kFramesAtOnce / oracle_payloads(kPayloadsPerMessage));
  auto files = public_files();
  files.push_back(kOwnDbc);
  OracleTally all;
  for (const auto& path : files) {
    if (is_broken(path)) continue;  // refused by us, on purpose
    const Database d = load(path);
    const std::span<const Message> messages{d.messages};
    OracleTally tally;
    for (std::size_t i = 0; i < messages.size(); i += at_once) {
      compare(path, d, messages.subspan(i, std::min(at_once, messages.size() - i)), tally);
    }
    std::printf("%-40s %8llu frames %9llu values %llu mismatches\n", path.filename().c_str(),
                static_cast<unsigned long long>(tally.frames),
                static_cast<unsigned long long>(tally.values),
                static_cast<unsigned long long>(tally.mismatches));
    std::fflush(stdout);
    all.frames += tally.frames;
    all.values += tally.values;
    all.mismatches += tally.mismatches;
    all.refused.merge(tally.refused);
  }
  std::printf("%llu values of %llu frames compared\n", static_cast<unsigned long long>(all.values),
              static_cast<unsigned long long>(all.frames));
  for (const auto& [what, count] : all.refused) {
    std::printf("canmatrix cannot decode %llu frames of %s\n",
                static_cast<unsigned long long>(count), what.c_str());
  }
  EXPECT_TRUE(all.refused.empty());
  EXPECT_EQ(all.mismatches, 0U);
  EXPECT_GT(all.values, 170 * kPayloadsPerMessage);
}

// The database that Debian's canmatrix brings along: J1939 with messages up to 1785 bytes, signals
// longer than 64 bits, signals outside of their messages and overlaps. What we leave out is told by
// name, and everything else is as canmatrix reads it.
TEST(CanmatrixOracle, ABadDatabaseIsReadButForWhatIsNamed) {
  ASSERT_TRUE(has_canmatrix()) << kPython << " has no canmatrix (python3-canmatrix)";
  const std::filesystem::path path = "/usr/lib/python3/dist-packages/canmatrix/j1939.dbc";
  ASSERT_TRUE(std::filesystem::exists(path)) << path;
  const Database d = leniently(text_of(path), "j1939.dbc");
  const std::string errors = errors_of(d);
  std::size_t kept = 0, named = 0;
  ask_canmatrix(path, "", [&](std::string_view line) {
    const OracleLayout o = layout_of(std::string{line});
    const Message* const m = d.find(o.id, o.is_extended);
    ASSERT_NE(m, nullptr) << line;
    const bool is_ascii =
        std::all_of(o.name.begin(), o.name.end(), [](char c) { return (c & 0x80) == 0; });
    if (!is_ascii) {  // read as Latin-1 there
      const auto has_its_bits = [&](const Signal& s) {
        return s.layout.start == o.start && s.layout.length == o.length;
      };
      EXPECT_TRUE(std::any_of(m->signals.begin(), m->signals.end(), has_its_bits)) << line;
      ++kept;
      return;
    }
    if (m->find(o.name) != nullptr) {
      expect_same_layout(d, std::string{line});
      ++kept;
      return;
    }
    const auto names_it = [&](const Problem& flaw) { return flaw.what.ends_with("left out"); };
    EXPECT_TRUE(std::any_of(m->flaws.begin(), m->flaws.end(), names_it)) << line << errors;
    ++named;
  });
  EXPECT_EQ(kept, signals_of(d));
  const auto left_out = static_cast<std::size_t>(
      std::count_if(d.findings.begin(), d.findings.end(),
                    [](const Finding& f) { return f.outcome.ends_with("left out"); }));
  EXPECT_EQ(named, left_out) << errors;
  std::printf("%zu signals as canmatrix reads them, %zu left out and named, of %zu messages\n",
              kept, named, d.messages.size());
  EXPECT_GT(kept, 2000U);
  EXPECT_GT(named, 0U);
}

}  // namespace
}  // namespace pitwall::can

// Damages of logs in every format: never a crash, and none that breaks the format is silent. A
// damage may be silent only where what is left is a legal file: each changed line of a text is one
// by a grammar that is written again here; in a binary file only bytes that hold a value were
// changed, and every record still is where it was.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <regex>
#include <set>

#include "hil/replay/formats/log_reader.hpp"
#include "hil/replay/writers/log_writer.hpp"
#include "tests/hil/replay/formats/made_log.hpp"

namespace pitwall::replay {
namespace {

constexpr std::size_t kDamages = 500;

// What a user is told of a log, as one text: a damage that leaves it as it was is silent.
std::string reported(const CanLog& log) {
  return to_text(log, "f") + std::to_string(log.counters.comments) + " " +
         std::to_string(log.counters.blank_lines);
}

std::string damaged(std::string bytes, Random& random) {
  const std::size_t at = random.below(bytes.size());
  switch (random.below(6)) {
    case 0:
      bytes.resize(at);
      break;
    case 1:
      bytes[at] = static_cast<char>(bytes[at] ^ 1 << random.below(8));
      break;
    case 2:
      bytes.insert(at, 1, static_cast<char>(random.next()));
      break;
    case 3:
      bytes.erase(at, 1 + random.below(4));
      break;
    case 4: {  // an end of a line becomes another
      const std::size_t end = bytes.find('\n', at);
      if (end != std::string::npos) bytes.replace(end, 1, random.one_in(2) ? "\r" : "\r\n");
      break;
    }
    default: {  // an end of a line is lost, or one more comes in
      const std::size_t end = bytes.find('\n', at);
      if (end == std::string::npos || random.one_in(2))
        bytes.insert(at, 1, '\n');
      else
        bytes.erase(end, 1);
    }
  }
  return bytes;
}

const std::regex& grammar_of(const std::string& name) {
  static const std::regex kCandump{
      R"([ \t]*\((\d{1,10})\.(\d{1,9})\)[ \t]+\S{1,15}[ \t]+([0-9A-Fa-f]{3}|[0-9A-Fa-f]{8})#)"
      R"((R[0-8]?|#[0-9A-Fa-f](([0-9A-Fa-f]{2}\.?)*)|(([0-9A-Fa-f]{2}\.?){0,8})(_[9A-Fa-f])?))"
      R"(([ \t]+[RT])?[ \t]*)",
      std::regex::icase};
  static const std::regex kAsc{
      R"([ \t]*(\d+[.,]\d{1,9}[ \t]+(\d+[ \t]+[0-9A-F]+x?[ \t]+(Rx|Tx|TxRq)[ \t]+)"
      R"((d[ \t]+[0-9A-F]([ \t]+[0-9A-F]{1,3}){0,8}|r([ \t]+[0-9A-F])?)|)"
      R"(CANFD[ \t]+\d+[ \t]+(Rx|Tx|TxRq)[ \t]+[0-9A-F]+x?([ \t]+\S+)?[ \t]+[01][ \t]+[01][ \t]+)"
      R"([0-9A-F][ \t]+\d+([ \t]+[0-9A-F]{1,8})*)[ \t]*|date .*|base (hex|dec).*|)"
      R"((no )?internal events logged.*|//.*|(begin|end) ?triggerblock.*|)"
      R"(\d+[.,]\d{1,9}[ \t]+(?!.*\b[RT]x\b)[^\d\s].*))",
      std::regex::icase};
  return name.ends_with(".log") ? kCandump : kAsc;
}

// PEAK's own description of a row of version 2.1, word by word.
bool is_legal_trc(const std::string& line) {
  static const std::regex kHead{
      R"(\s*\d+\s+\d+([.,]\d{1,9})?\s+(DT|RR|FD|FB|FE|BI)\s+(-|\d{1,3})\s+)"
      R"(([0-9A-Fa-f]{1,4}|[01]?[0-9A-Fa-f]{5,7})\s+(Rx|Tx)\s+\S+\s+(\d{1,3}))"
      R"(((\s+[0-9A-Fa-f]{2})*)\s*)"};
  static const std::size_t kLengths[] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 12, 16, 20, 24, 32, 48, 64};
  if (line.find_first_not_of(" \t") == line.find(';')) return true;
  std::smatch parts;
  if (!std::regex_match(line, parts, kHead)) return false;
  const std::string data = parts[7].str();
  const std::size_t code = std::stoul(parts[6].str());
  const auto digits = std::count_if(data.begin(), data.end(), [](char c) { return c > ' '; });
  const std::size_t bytes = static_cast<std::size_t>(digits) / 2;
  if (code > 15 || parts[2] == "RR") return code <= 15 && bytes == 0;
  return bytes == (parts[2] == "DT" ? std::min<std::size_t>(code, 8) : kLengths[code]);
}

bool is_legal(const std::string& name, const std::string& line) {
  return name.ends_with(".trc") ? is_legal_trc(line) : std::regex_match(line, grammar_of(name));
}

std::multiset<std::string> lines_of(const std::string& text) {
  std::multiset<std::string> out;
  std::string line;
  for (const char c : text) {
    if (c != '\n' && c != '\r') {
      line += c;
      continue;
    }
    out.insert(line);
    line.clear();
  }
  return out;
}

// The first line that was not in the good text and is none of the format; or that the text ends
// without a line end.
std::string illegal_line(const std::string& name, const std::string& good, const std::string& bad) {
  const auto before = lines_of(good);
  if (bad.empty() || (bad.back() != '\n' && bad.back() != '\r')) return "the end";
  for (const std::string& line : lines_of(bad))
    if (!before.contains(line) && line.find_first_not_of(" \t") != std::string::npos &&
        !is_legal(name, line))
      return line;
  return "";
}

// A change inside the values of a capture's records (stamps, identifiers, data, padding, options)
// or of the file's description moves nothing; a cut between two records leaves a whole file.
bool is_legal_binary(const std::string& good, const std::string& bad,
                     const std::vector<std::pair<std::size_t, std::size_t>>& structure) {
  if (bad.size() < good.size() && good.starts_with(bad))
    return std::any_of(structure.begin(), structure.end(),
                       [&](const auto& part) { return part.first == bad.size(); });
  if (bad.size() != good.size()) return false;
  for (const auto& [begin, end] : structure)
    if (good.compare(begin, end - begin, bad, begin, end - begin) != 0) return false;
  return true;
}

// Of a pcap with classic frames: magic, version and link type; lengths of each record and frame.
std::vector<std::pair<std::size_t, std::size_t>> structure_of_pcap(const std::string& bytes) {
  std::vector<std::pair<std::size_t, std::size_t>> out{{0, 6}, {20, 22}};
  for (std::size_t at = 24; at < bytes.size(); at += 32) {
    out.emplace_back(at, at);  // a record begins: a cut here leaves a whole file
    out.emplace_back(at + 8, at + 16);
  }
  return out;
}

TEST(Damage, NoneThatBreaksATextIsSilent) {
  for (const std::string name : {"a.log", "a.asc", "a.trc"}) {
    Random random{.state = 5};
    const std::string good = write_can_log(make_log({.frames = 60}), name)->bytes;
    const std::string clean = reported(*read_can_log(good, "f"));
    std::size_t silent = 0;
    for (std::size_t i = 0; i < kDamages; ++i) {
      const std::string bad = damaged(good, random);
      const auto log = read_can_log(bad, "f");
      if (!log || reported(*log) != clean) continue;
      ++silent;
      EXPECT_EQ(illegal_line(name, good, bad), "") << name << " " << i;
    }
    std::printf("%s: %zu of %zu damages leave a legal file\n", name.c_str(), silent, kDamages);
    EXPECT_LT(silent, kDamages / 2);
  }
}

TEST(Damage, NoneThatBreaksACaptureIsSilent) {
  Random random{.state = 6};
  const std::string good =
      write_can_log(make_log({.frames = 60, .channels = 1, .fd = false}), "a.pcap")->bytes;
  const std::string clean = reported(*read_can_log(good, "f"));
  const auto structure = structure_of_pcap(good);
  std::size_t silent = 0;
  for (std::size_t i = 0; i < kDamages; ++i) {
    const std::string bad = damaged(good, random);
    const auto log = read_can_log(bad, "f");
    if (!log || reported(*log) != clean) continue;
    ++silent;
    EXPECT_TRUE(is_legal_binary(good, bad, structure)) << i;
  }
  std::printf("pcap: %zu of %zu damages leave a legal file\n", silent, kDamages);
}

// What is packed has a checksum, a block of pcapng its length twice: whatever changes a frame is
// told, but for the values of a packet's own bytes.
TEST(Damage, OfPackedAndFramedFilesNothingIsLostInSilence) {
  for (const std::string name : {"a.blf", "a.pcapng"}) {
    Random random{.state = 7};
    const CanLog made = make_log({.frames = 300});
    const std::string good = write_can_log(made, name)->bytes;
    const std::string clean = reported(*read_can_log(good, "f"));
    for (std::size_t i = 0; i < kDamages; ++i) {
      const std::string bad = damaged(good, random);
      const auto log = read_can_log(bad, "f");
      if (!log || reported(*log) != clean) continue;
      const bool is_cut = name == "a.pcapng" && good.starts_with(bad);
      EXPECT_TRUE(is_cut || log->frames.size() == made.frames.size()) << name << " " << i;
    }
  }
}

// gzip's checksum is of all that is packed; only the stamp and the name of the system in its header
// may be anything.
TEST(Damage, OfAGzipFileNoneThatChangesAFrameIsSilent) {
  for (const std::string name : {"a.log.gz", "a.trc.gz"}) {
    Random random{.state = 8};
    const std::string good = write_can_log(make_log({.frames = 60}), name)->bytes;
    const auto made = read_can_log(good, "f");
    const std::string clean = reported(*made);
    std::size_t silent = 0;
    for (std::size_t i = 0; i < kDamages; ++i) {
      const std::string bad = damaged(good, random);
      const auto log = read_can_log(bad, "f");
      if (!log || reported(*log) != clean) continue;
      ++silent;
      EXPECT_EQ(log->frames, made->frames) << name << " " << i;
      EXPECT_EQ(log->channels, made->channels) << name << " " << i;
    }
    std::printf("%s: %zu of %zu damages leave the same frames\n", name.c_str(), silent, kDamages);
    EXPECT_LT(silent, kDamages / 10);
  }
}

}  // namespace
}  // namespace pitwall::replay

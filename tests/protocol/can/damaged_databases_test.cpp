// SPDX-License-Identifier: Apache-2.0
// Damage done to databases at seeded places. What breaks the grammar, a length or a line is never
// silent: a finding names its place, and the messages that it does not touch are read as before.
// Values that change and stay legal are read.
#include <gtest/gtest.h>

#include <charconv>
#include <set>

#include "protocol/can/difference.hpp"
#include "tests/protocol/can/dbc_files.hpp"

namespace pitwall::can {
namespace {

constexpr int kDamages = 250;

struct Damage {
  std::string text, kind;
  std::size_t line = 0;  // of the damage, counted from one
};

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> out(1);
  for (const char c : text) {
    if (c == '\n') {
      out.emplace_back();
    } else {
      out.back() += c;
    }
  }
  return out;
}

std::string joined(const std::vector<std::string>& lines) {
  std::string out;
  for (std::size_t i = 0; i < lines.size(); ++i) out += (i == 0 ? "" : "\n") + lines[i];
  return out;
}

bool begins_with_one_of(const std::string& line, std::initializer_list<const char*> words) {
  const std::size_t at = std::min(line.find_first_not_of(' '), line.size());
  return std::any_of(words.begin(), words.end(), [&](const char* word) {
    return std::string_view{line}.substr(at).starts_with(word);
  });
}

// A way to break a line; false where the line does not have what it breaks.
struct Break {
  const char* kind;
  bool (*apply)(std::string& line, Random& noise);
};

bool erase_one(std::string& line, std::string_view of, Random& noise) {
  std::vector<std::size_t> at;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (of.find(line[i]) != std::string_view::npos) at.push_back(i);
  }
  if (at.empty()) return false;
  line.erase(at[noise.below(at.size())], 1);
  return true;
}

bool replace_number(std::string& line, const std::string& behind, const std::string& with) {
  const std::size_t at = line.find(behind);
  if (at == std::string::npos) return false;
  const std::size_t begin = line.find_first_of("0123456789", at + behind.size());
  const std::size_t end = line.find_first_not_of("0123456789", begin);
  if (begin == std::string::npos || end == std::string::npos) return false;
  line.replace(begin, end - begin, with);
  return true;
}

bool is_message(const std::string& line) { return begins_with_one_of(line, {"BO_ "}); }
bool is_signal(const std::string& line) { return begins_with_one_of(line, {"SG_ "}); }
// Whole in its line: a line of a longer text may hold a semicolon that ends nothing.
bool is_detail(const std::string& line) {
  const std::size_t last = line.find_last_not_of(" \r");
  return begins_with_one_of(line,
                            {"CM_ \"", "CM_ BO_", "CM_ SG_", "VAL_ ", "BA_ \"", "BA_DEF_ "}) &&
         line[last] == ';' && std::count(line.begin(), line.end(), '"') % 2 == 0;
}

const Break kBreaks[] = {
    {"a semicolon is missing",
     [](std::string& l, Random&) {
       if (!is_detail(l)) return false;
       l.erase(l.rfind(';'), 1);
       return true;
     }},
    {"a quote is missing",
     [](std::string& l, Random& noise) { return is_detail(l) && erase_one(l, "\"", noise); }},
    {"a quote of the unit is missing",
     [](std::string& l, Random& noise) { return is_signal(l) && erase_one(l, "\"", noise); }},
    {"a mark is missing",
     [](std::string& l, Random& noise) { return is_signal(l) && erase_one(l, "|@:()[],", noise); }},
    {"a colon is missing",
     [](std::string& l, Random& noise) { return is_message(l) && erase_one(l, ":", noise); }},
    {"a letter of the section is missing",
     [](std::string& l, Random& noise) {
       if (!is_message(l) && !is_signal(l) && !is_detail(l)) return false;
       l.erase(l.find('_') - noise.below(2), 1);
       return true;
     }},
    {"a number is a word",
     [](std::string& l, Random&) {
       if (!is_message(l) && !is_signal(l)) return false;
       return replace_number(l, is_message(l) ? ":" : "@", "x1");
     }},
    {"a message is longer than any",
     [](std::string& l, Random&) { return is_message(l) && replace_number(l, ":", "4000"); }},
    {"a message is longer than a frame",
     [](std::string& l, Random&) { return is_message(l) && replace_number(l, ":", "100"); }},
    {"a signal is longer than any",
     [](std::string& l, Random&) { return is_signal(l) && replace_number(l, "|", "72"); }},
    {"a signal is empty",
     [](std::string& l, Random&) { return is_signal(l) && replace_number(l, "|", "0"); }},
    {"a signal begins behind its message",
     [](std::string& l, Random&) { return is_signal(l) && replace_number(l, ":", "600"); }},
    {"the line is cut",
     [](std::string& l, Random& noise) {
       if (!is_message(l) && !is_signal(l) && !is_detail(l)) return false;
       const std::size_t last = is_message(l)  ? l.rfind(' ')
                                : is_signal(l) ? l.rfind('"')
                                               : l.rfind(';');
       const std::size_t first = l.find('_') + 2;
       if (last <= first) return false;
       l.resize(first + noise.below(last - first));
       return true;
     }},
    {"the line is cut by a line end", [](std::string& l, Random& noise) {
       if (!is_signal(l)) return false;
       const std::size_t at = l.find("SG_") + 1 + noise.below(2);
       l.insert(at, noise.below(2) == 0 ? "\n" : "\r\n");
       return true;
     }}};

// A signal that belongs to no message, so that it has no length to lie in.
bool is_parked(const std::vector<std::string>& lines, std::size_t i) {
  while (i > 0 && !is_message(lines[i])) --i;
  return lines[i].find("VECTOR__INDEPENDENT_SIG_MSG") != std::string::npos;
}

Damage damaged(const std::string& text, Random& noise) {
  std::vector<std::string> lines = lines_of(text);
  while (true) {
    const Break& way = kBreaks[noise.below(std::size(kBreaks))];
    for (std::size_t attempt = 0; attempt < 10 * lines.size(); ++attempt) {
      const std::size_t i = noise.below(lines.size());
      std::string line = lines[i];
      if (is_parked(lines, i) || !way.apply(line, noise)) continue;
      lines[i] = line;
      return {joined(lines), way.kind, i + 1};
    }
  }
}

std::size_t line_of(const std::string& place) {
  const std::size_t last = place.rfind(':'), first = place.rfind(':', last - 1);
  std::size_t line = 0;
  std::from_chars(place.data() + first + 1, place.data() + last, line);
  return line;
}

// From the damaged line to the next one that says something: there a missing end is noticed. What
// was told before the damage does not count.
bool names_the_place(const Database& before, const Database& d, const Damage& damage) {
  std::set<std::string> known;
  for (const Finding& f : before.findings) known.insert(f.what);
  const std::vector<std::string> lines = lines_of(damage.text);
  std::size_t last = damage.line + 1;
  while (last < lines.size() && lines[last - 1].find_first_not_of(" \r") == std::string::npos)
    ++last;
  return std::any_of(d.findings.begin(), d.findings.end(), [&](const Finding& f) {
    const std::size_t line = line_of(f.place);
    return !known.contains(f.what) && line >= damage.line && line <= last;
  });
}

std::vector<std::filesystem::path> sound_files() {
  std::vector<std::filesystem::path> out;
  for (const char* name : {"av21.dbc", "av24.dbc", "integrity_bench.dbc"}) {
    out.push_back(kSource / "protocol/can/dbc" / name);
  }
  for (const auto& path : public_files()) {
    if (!is_broken(path) && load(path).messages.size() > 1) out.push_back(path);
  }
  return out;
}

// Messages that are no longer what they were.
std::size_t changed_messages(const Database& before, const Database& now) {
  std::size_t changed = 0;
  for (const Message& m : before.messages) {
    const Message* const same = now.find(m.id, m.extended);
    Database one, other;
    one.messages = {m};
    if (same != nullptr) other.messages = {*same};
    if (same == nullptr || fingerprint(one) != fingerprint(other)) ++changed;
  }
  return changed;
}

TEST(DamagedDatabases, NoDamageOfTheGrammarIsSilent) {
  Random noise{20};
  std::map<std::string, int> kinds;
  const auto files = sound_files();
  int refused = 0;
  for (int i = 0; i < kDamages; ++i) {
    const auto& path = files[static_cast<std::size_t>(i) % files.size()];
    const std::string text = text_of(path);
    const Database before = leniently(text);
    ASSERT_EQ(before.count(FindingSeverity::kError), 0U) << path;
    const Damage damage = damaged(text, noise);
    ++kinds[damage.kind];
    const std::string at = path.filename().string() + ":" + std::to_string(damage.line) + ": " +
                           damage.kind + ": " + lines_of(damage.text)[damage.line - 1];
    const auto now = parse_dbc_leniently(damage.text, "t.dbc");
    ASSERT_TRUE(now) << at;
    EXPECT_TRUE(names_the_place(before, *now, damage)) << at << "\n" << errors_of(*now);
    EXPECT_LE(changed_messages(before, *now), 1U) << at << "\n" << errors_of(*now);
    EXPECT_EQ(parse_dbc(damage.text, "t.dbc").has_value(), errors_of(*now).empty()) << at;
    refused += errors_of(*now).empty() ? 0 : 1;
  }
  EXPECT_EQ(kinds.size(), std::size(kBreaks));
  EXPECT_GT(refused, kDamages * 9 / 10);  // the rest is an unknown section, told as a warning
}

// A file that ends within a statement, wherever that is.
TEST(DamagedDatabases, ACutFileIsTold) {
  Random noise{21};
  const std::string text = text_of(kOwnDbc);
  const Database before = leniently(text);
  for (int i = 0; i < kDamages; ++i) {
    std::size_t end = 0;
    while (true) {  // behind the first message, where a statement is not yet complete
      end = text.find("BO_ ") + 4 + noise.below(text.size() - text.find("BO_ ") - 4);
      const std::string line = lines_of(text.substr(0, end)).back();
      const std::string rest = text.substr(end, text.find('\n', end) - end);
      const char needed = is_signal(line) ? '"' : is_message(line) ? ':' : ';';
      if (begins_with_one_of(line, {"BO_ ", "SG_ ", "CM_ ", "VAL_ "}) &&
          rest.find(needed) != std::string::npos) {
        break;
      }
    }
    const Damage damage{text.substr(0, end), "cut", lines_of(text.substr(0, end)).size()};
    const Database now = leniently(damage.text);
    EXPECT_TRUE(names_the_place(before, now, damage)) << end << "\n" << errors_of(now);
    EXPECT_FALSE(parse_dbc(damage.text, "t.dbc")) << end;
    EXPECT_LE(now.messages.size(), before.messages.size());
  }
}

// Digits that become others: whatever it says now, it is read, and errors are told.
TEST(DamagedDatabases, ChangedValuesAreReadOrTold) {
  Random noise{22};
  const auto files = sound_files();
  int accepted = 0;
  for (int i = 0; i < 2 * kDamages; ++i) {
    std::string text = text_of(files[static_cast<std::size_t>(i) % files.size()]);
    for (int k = 0; k < 3; ++k) {
      const std::size_t from = noise.below(text.size());
      const std::size_t at = text.find_first_of("0123456789", from);
      if (at != std::string::npos) text[at] = static_cast<char>('0' + noise.below(10));
    }
    const Database d = leniently(text);
    const auto strict = parse_dbc(text, "t.dbc");
    EXPECT_EQ(strict.has_value(), errors_of(d).empty());
    EXPECT_TRUE(!strict || fingerprint(*strict) == fingerprint(d));
    accepted += strict ? 1 : 0;
  }
  EXPECT_GT(accepted, kDamages / 2);
}

}  // namespace
}  // namespace pitwall::can

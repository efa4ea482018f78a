// SPDX-License-Identifier: Apache-2.0
#include "protocol/can/database.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <set>

#include "tests/protocol/can/dbc_files.hpp"

namespace pitwall::can {
namespace {

TEST(Database, FindsEveryMessageAndNothingElse) {
  const Database d = load(kOwnDbc);
  ASSERT_EQ(d.messages.size(), 47U);
  std::set<std::uint32_t> ids;
  for (const Message& m : d.messages) {
    EXPECT_EQ(d.find(m.id), &m);
    EXPECT_EQ(d.find(m.name), &m);
    EXPECT_EQ(d.find(m.id, true), nullptr);
    for (const Signal& s : m.signals) EXPECT_EQ(m.find(s.name), &s);
    EXPECT_EQ(m.find("x"), nullptr);
    ids.insert(m.id);
  }
  for (std::uint32_t id = 0; id <= kMaxStandardId; ++id) {
    EXPECT_EQ(d.find(id) != nullptr, ids.contains(id));
  }
  EXPECT_EQ(d.find("nothing"), nullptr);
}

TEST(Database, TheIndexFindsWhatTheDatabaseFinds) {
  Random noise{11};
  std::string text = "BU_: A\n";
  std::set<std::uint32_t> ids;
  while (ids.size() < 3000) {
    ids.insert(noise.below(3) == 0
                   ? static_cast<std::uint32_t>(noise.below(kMaxStandardId + 1))
                   : 0x80000000U + static_cast<std::uint32_t>(noise.below(1U << 16U)));
  }
  for (const std::uint32_t id : ids) {
    text += "BO_ " + std::to_string(id) + " M" + std::to_string(id) + ": 8 A\n";
  }
  const Database d = parsed(text);
  const MessageIndex index{d};
  for (const Message& m : d.messages) EXPECT_EQ(index.find(m.id, m.extended), &m);
  for (std::uint32_t id = 0; id < 1U << 17U; ++id) {
    ASSERT_EQ(index.find(id, true), d.find(id, true));
    ASSERT_EQ(index.find(id, false), d.find(id, false));
  }
  EXPECT_EQ(MessageIndex{Database{}}.find(5, true), nullptr);
}

// The fingerprint must see everything that moves a bit or a value, and nothing else.
TEST(Database, FingerprintSeesTheLayoutOnly) {
  const Database original = load(kOwnDbc);
  const std::uint64_t print = fingerprint(original);
  std::set<std::uint64_t> seen{print};
  const auto changed = [&](auto change) {
    Database d = original;
    change(d.messages[5], d.messages[5].signals[0]);
    EXPECT_TRUE(seen.insert(fingerprint(d)).second);
  };
  changed([](Message& m, Signal&) { ++m.id; });
  changed([](Message& m, Signal&) { ++m.length; });
  changed([](Message& m, Signal&) { m.extended = true; });
  changed([](Message& m, Signal&) { m.name += "x"; });
  changed([](Message& m, Signal&) { m.signals.pop_back(); });
  changed([](Message&, Signal& s) { s.name += "x"; });
  changed([](Message&, Signal& s) { ++s.layout.start; });
  changed([](Message&, Signal& s) { ++s.layout.length; });
  changed([](Message&, Signal& s) { s.layout.order = ByteOrder::kMotorola; });
  changed([](Message&, Signal& s) { s.layout.number = Number::kSigned; });
  changed([](Message&, Signal& s) { s.layout.scale *= 2; });
  changed([](Message&, Signal& s) { s.layout.offset += 1; });
  changed([](Message&, Signal& s) { s.layout.max += 1; });
  Database d = original;
  d.name = "other";
  d.messages[5].comment = "other";
  d.messages[5].signals[0].unit = "other";
  std::reverse(d.messages[5].signals.begin(), d.messages[5].signals.end());
  EXPECT_EQ(fingerprint(d), print);
}

TEST(Database, NamesTheContradiction) {
  EXPECT_EQ(complaint(dbc_with(" SG_ a : 60|8@1+ (1,0) [0|0] \"\" A")),
            "t.dbc:8:6: error: signal a lies outside the 8 bytes of message M");
  EXPECT_EQ(complaint(dbc_with(" SG_ a : 3|8@0+ (1,0) [0|0] \"\" A", 1)),
            "t.dbc:8:6: error: signal a lies outside the 1 bytes of message M");
  EXPECT_EQ(complaint(dbc_with(" SG_ a : 0|8@1+ (1,0) [0|0] \"\" A\n"
                               " SG_ b : 7|2@1+ (1,0) [0|0] \"\" A")),
            "t.dbc:9:6: error: signal b overlaps signal a defined at t.dbc:8:6");
  EXPECT_EQ(complaint(dbc_with(" SG_ a : 0|8@1+ (1,0) [0|0] \"\" A\n"
                               " SG_ a : 8|8@1+ (1,0) [0|0] \"\" A")),
            "t.dbc:9:6: error: signal a is already defined at t.dbc:8:6");
}

TEST(Database, MultiplexedSignalsMayShareBitsOnlyIfNeverPresentTogether) {
  const std::string mux = " SG_ s M : 0|8@1+ (1,0) [0|0] \"\" A\n";
  const auto with = [&](const std::string& a, const std::string& b, const std::string& more = "") {
    return complaint(dbc_with(mux + " SG_ a " + a + " : 8|8@1+ (1,0) [0|0] \"\" A\n SG_ b " + b +
                              " : 8|8@1+ (1,0) [0|0] \"\" A\n" + more));
  };
  EXPECT_EQ(with("m1", "m2"), "");
  EXPECT_NE(with("m1", "m1"), "");
  EXPECT_NE(with("m1", ""), "");
  EXPECT_NE(with("m1", "m2", "SG_MUL_VAL_ 100 b s 0-1;\n"), "");
  EXPECT_EQ(with("m1", "m2", "SG_MUL_VAL_ 100 b s 2-3, 7-9;\n"), "");
}

// Whether two signals can meet, asked of every value of two selectors instead of the ranges.
TEST(Database, OverlapsAreFoundWhereSignalsCanMeet) {
  Random noise{3};
  int refused = 0;
  for (int round = 0; round < 400; ++round) {
    std::array<std::array<std::pair<unsigned, unsigned>, 2>, 2> when{};
    std::string links;
    const bool is_below = noise.below(2) == 0;  // b hangs on t, a selector that hangs on s
    for (std::size_t k = 0; k < 2; ++k) {
      links += std::string("SG_MUL_VAL_ 100 ") + (k == 0 ? "a s " : is_below ? "t s " : "b s ");
      for (std::size_t r = 0; r < 2; ++r) {
        const auto low = static_cast<unsigned>(noise.below(12));
        when[k][r] = {low, low + static_cast<unsigned>(noise.below(3))};
        links +=
            (r == 0 ? "" : ",") + std::to_string(low) + "-" + std::to_string(when[k][r].second);
      }
      links += ";\n";
    }
    if (is_below) links += "SG_MUL_VAL_ 100 b t 5-5;\n";
    const std::string text = dbc_with(
        " SG_ s M : 0|8@1+ (1,0) [0|0] \"\" A\n SG_ a m0 : 16|8@1+ (1,0) [0|0] \"\" A\n"
        " SG_ b m0 : 16|8@1+ (1,0) [0|0] \"\" A\n" +
        std::string(is_below ? " SG_ t m0M : 8|8@1+ (1,0) [0|0] \"\" A\n" : "") + links);
    bool can_meet = false;
    for (unsigned s = 0; s < 20; ++s) {
      const auto is_in = [s](const auto& ranges) {
        return std::any_of(ranges.begin(), ranges.end(),
                           [s](const auto& r) { return r.first <= s && s <= r.second; });
      };
      can_meet = can_meet || (is_in(when[0]) && is_in(when[1]));
    }
    EXPECT_EQ(complaint(text) != "", can_meet) << text;
    refused += can_meet ? 1 : 0;
  }
  EXPECT_GT(refused, 50);
  EXPECT_LT(refused, 350);
}

}  // namespace
}  // namespace pitwall::can

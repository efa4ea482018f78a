// SPDX-License-Identifier: Apache-2.0
#include "protocol/can/parser/dbc_remarks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include "protocol/can/parser/dbc_draft.hpp"
#include "protocol/vocabulary/text.hpp"

namespace pitwall::can {
namespace {

constexpr std::size_t kMostNames = 4;  // that are listed before "and 3 more"
// Of the field, for ranges that were rounded when they were written down.
constexpr double kRoundingSlack = 1e-6;

std::string listed(const std::vector<std::string_view>& names) {
  std::string out;
  for (std::size_t i = 0; i < std::min(names.size(), kMostNames); ++i) {
    out += (i == 0 ? "" : ", ") + std::string{names[i]};
  }
  if (names.size() > kMostNames)
    out += " and " + std::to_string(names.size() - kMostNames) + " more";
  return out;
}

bool is_frame_length(unsigned bytes) {
  static constexpr std::array<unsigned, 7> kLongOnes{12, 16, 20, 24, 32, 48, 64};
  return bytes <= 8 || std::find(kLongOnes.begin(), kLongOnes.end(), bytes) != kLongOnes.end();
}

// One for each oddity of a signal.
using Texts = std::vector<std::pair<FindingKind, std::string>>;

struct Limits {
  double low = 0.0, high = 0.0;
};

// What the bits can say, whatever range the file gives.
Limits limits_of_field(const Signal& s) {
  SignalLayout free = s.layout;
  free.min = free.max = 0.0;
  const SignalPlan p = plan(free);
  const double a = p.raw_min * p.scale + p.offset, b = p.raw_max * p.scale + p.offset;
  return {std::min(a, b), std::max(a, b)};
}

void judge_range(const Signal& s, Texts& out) {
  const SignalLayout& l = s.layout;
  const std::string range = "[" + shortest(l.min) + "|" + shortest(l.max) + "]";
  if (l.min > l.max) {
    out.emplace_back(FindingKind::kRange,
                     "signal " + s.name + ": the range " + range + " is upside down");
  }
  if (!(l.min < l.max)) return;
  const Limits field = limits_of_field(s);
  const bool is_float = l.number == Number::kFloat32 || l.number == Number::kFloat64;
  const double slack = kRoundingSlack * (is_float ? field.high : std::abs(l.scale)) +
                       kRoundingSlack * kRoundingSlack * std::max(std::abs(l.min), std::abs(l.max));
  const std::string holds = "[" + shortest(field.low) + "|" + shortest(field.high) + "]";
  const bool is_empty = !is_float &&
                        std::floor((l.max - l.offset) / l.scale + kRoundingSlack) <
                            std::ceil((l.min - l.offset) / l.scale - kRoundingSlack) &&
                        l.scale > 0.0;
  if (l.min > field.high + slack || l.max < field.low - slack || is_empty) {
    out.emplace_back(FindingKind::kRange, "signal " + s.name + ": no value that its " +
                                              std::to_string(l.length) +
                                              " bits can hold is in the range " + range);
  } else if (l.min < field.low - slack || l.max > field.high + slack) {
    out.emplace_back(FindingKind::kRange, "signal " + s.name + ": the range " + range +
                                              " is wider than its " + std::to_string(l.length) +
                                              " bits can hold, " + holds);
  }
}

void judge_value_names(const Signal& s, Texts& out) {
  const bool is_signed = s.layout.number == Number::kSigned;
  if (!is_signed && s.layout.number != Number::kUnsigned) return;
  const std::uint64_t mask = mask_of(s.layout.length);
  std::vector<std::string> outside;
  for (const ValueName& v : s.values) {
    const bool fits =
        is_signed
            ? v.value == sign_extended(static_cast<std::uint64_t>(v.value) & mask, s.layout.length)
            : v.value >= 0 && static_cast<std::uint64_t>(v.value) <= mask;
    if (!fits) outside.push_back(std::to_string(v.value));
  }
  if (outside.empty()) return;
  out.emplace_back(FindingKind::kValueNames, "signal " + s.name + ": VAL_ names values that its " +
                                                 std::to_string(s.layout.length) + " bits " +
                                                 (is_signed ? "with sign " : "") + "cannot hold: " +
                                                 listed({outside.begin(), outside.end()}));
}

void judge_selector(const Message& m, const Signal& s, Texts& out) {
  if (!s.selector) return;
  const Signal& selector = m.signals[*s.selector];
  const std::uint64_t mask = mask_of(selector.layout.length);
  const bool is_reachable = std::any_of(s.when.begin(), s.when.end(),
                                        [&](const SelectorRange& r) { return r.low <= mask; });
  if (!is_reachable) {
    out.emplace_back(FindingKind::kNeverPresent,
                     "signal " + s.name + " is never present: its multiplexer " + selector.name +
                         " has only " + std::to_string(selector.layout.length) + " bits");
  }
}

}  // namespace

std::vector<Finding> remarks_on(const Message& m) {
  if (is_frame_length(m.length) || !m.is_on_frame()) return {};
  return {{FindingKind::kFrameLength, m.place,
           "message " + m.name + ": no CAN FD frame has " + std::to_string(m.length) + " bytes", "",
           m.name}};
}

std::vector<Finding> remarks_on(const Message& m, const Signal& s) {
  Texts texts;
  judge_range(s, texts);
  judge_value_names(s, texts);
  judge_selector(m, s, texts);
  if (s.receivers.empty()) {
    texts.emplace_back(FindingKind::kUnreceived, "signal " + s.name + ": nobody receives it");
  }
  std::vector<Finding> out;
  for (auto& [kind, text] : texts) {
    out.push_back({kind, s.place, std::move(text), "", m.name + "." + s.name});
  }
  return out;
}

std::vector<Finding> unlisted_nodes(const Database& d) {
  std::set<std::string_view> known{kNoNode, ""};
  for (const Node& n : d.nodes) known.insert(n.name);
  std::vector<Finding> out;
  const auto meet = [&](const std::string& name, const std::string& place, const char* role) {
    if (!known.insert(name).second) return;
    out.push_back({FindingKind::kNode, place,
                   std::string{role} + " " + name + " is not listed in BU_", "", name});
  };
  for (const Message& m : d.messages) {
    meet(m.sender, m.place, "sender");
    for (const std::string& name : m.other_senders) meet(name, m.place, "sender");
    for (const Signal& s : m.signals) {
      for (const std::string& name : s.receivers) meet(name, s.place, "receiver");
    }
  }
  return out;
}

}  // namespace pitwall::can

// SPDX-License-Identifier: Apache-2.0
#include "protocol/can/difference.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <string_view>
#include <utility>

#include "protocol/can/decode.hpp"
#include "protocol/vocabulary/text.hpp"

namespace pitwall::can {
namespace {

constexpr std::size_t kMostValues = 4;  // that one line lists

// For what was computed: without the last digits, which only show that 0.01 is not binary.
std::string rounded(double v) { return formatted("%.9g", v); }

std::string id_of(const Message& m) {
  return std::to_string(m.id) + (m.extended ? " extended" : "");
}

std::string quoted(std::string_view text) { return '"' + std::string{text} + '"'; }

std::string now_was(const std::string& now, const std::string& was) {
  return " is now " + now + ", was " + was;
}

const char* name_of(Number n) {
  constexpr std::array<const char*, 4> kNames{"unsigned", "signed", "a 32-bit float",
                                              "a 64-bit float"};
  return kNames[static_cast<std::size_t>(n)];
}

const char* name_of(ByteOrder order) {
  return order == ByteOrder::kIntel ? "little-endian (Intel)" : "big-endian (Motorola)";
}

// "always", or the selector values on the way down: "while mode is 3, 5-7 and page is 1".
std::string presence(const Message& m, const Signal& signal) {
  if (!signal.selector) return "always";
  std::string out;
  for (const Signal* s = &signal; s->selector; s = &m.signals[*s->selector]) {
    std::string values;
    for (const SelectorRange& r : s->when) {
      values += (values.empty() ? "" : ", ") + std::to_string(r.low) +
                (r.low == r.high ? "" : "-" + std::to_string(r.high));
    }
    out += (out.empty() ? "while " : " and ") + m.signals[*s->selector].name + " is " + values;
  }
  return out;
}

struct Example {
  double written = 0.0, read = 0.0;
  bool is_worse_than(const Example& o) const {
    return std::isfinite(written) && std::isfinite(read) &&
           std::abs(written - read) > std::abs(o.written - o.read);
  }
};

// What the reader makes of a value of the writer; the plainest of the worst.
Example misreading(const Signal& writer, const Signal& reader) {
  const SignalPlan &w = writer.plan, &r = reader.plan;
  const double low = w.raw_min * w.scale + w.offset, high = w.raw_max * w.scale + w.offset;
  Example worst;
  for (const double wanted : {-1.0, 1.0, 10.0, 100.0, low, high, (low + high) / 2.0}) {
    bool saturated = false;
    const std::uint64_t raw = raw_of(wanted, w, saturated);
    if (saturated) continue;
    FrameBytes bytes{};
    insert(w, bytes, raw);
    const Example e{physical_of(raw, w), physical_of(extract(r, bytes), r)};
    if (e.is_worse_than(worst)) worst = e;
  }
  return worst;
}

std::string reported(const Example& e, const std::string& unit) {
  if (e.written == e.read) return "";
  const bool flips = e.written < 0.0 && e.read > 0.0;
  return ": what one writes as " + rounded(e.written) + (unit.empty() ? "" : " " + unit) +
         " the other reads as " + (flips ? "+" : "") + rounded(e.read);
}

class Comparison {
 public:
  std::vector<Difference> run(const Database& one, const Database& other);

 private:
  using ByName = std::map<std::string_view, const Message*>;
  using Key = std::pair<bool, std::uint32_t>;
  using ById = std::map<Key, const Message*>;

  void add(Change change, const Message& m, std::string what) {
    found_.push_back({change, m.name + " (" + id_of(m) + ")" + std::move(what)});
  }
  void compare(const Message& a, const Message& b);
  void compare_frame(const Message& a, const Message& b);
  void compare_signals(const Message& a, const Message& b);
  void compare(const Message& a, const Signal& x, const Message& b, const Signal& y);
  void compare_reading(const Message& a, const Signal& x, const Message& b, const Signal& y);
  void compare_value_names(const Message& b, const Signal& x, const Signal& y);
  void one_sided(const Message& a, std::vector<const Signal*> gone, const Message& b,
                 std::vector<const Signal*> fresh);

  std::vector<Difference> found_;
};

std::map<std::string_view, const Signal*> by_name(const Message& m) {
  std::map<std::string_view, const Signal*> out;
  for (const Signal& s : m.signals) out[s.name] = &s;
  return out;
}

// A message that kept most of its signals was only renamed.
bool is_same_message(const Message& a, const Message& b) {
  if (a.name == b.name) return true;
  const auto names = by_name(b);
  std::size_t kept = 0;
  for (const Signal& s : a.signals) kept += names.count(s.name);
  return kept > 0 && 2 * kept >= std::max(a.signals.size(), b.signals.size());
}

std::vector<Difference> Comparison::run(const Database& one, const Database& other) {
  ByName names_a, names_b;
  ById ids_b;
  std::set<Key> ids_a;
  for (const Message& m : one.messages) names_a[m.name] = &m, ids_a.insert({m.extended, m.id});
  for (const Message& m : other.messages) names_b[m.name] = &m, ids_b[{m.extended, m.id}] = &m;
  for (const Message& a : one.messages) {
    const auto same_id = ids_b.find({a.extended, a.id});
    const auto same_name = names_b.find(a.name);
    const bool is_elsewhere = same_name != names_b.end();
    if (same_id != ids_b.end()) {
      const Message& b = *same_id->second;
      const bool is_renamed = !is_elsewhere && !names_a.contains(b.name) && is_same_message(a, b);
      if (a.name == b.name || is_renamed) {
        compare(a, b);
        continue;
      }
      found_.push_back({Change::kIdReused,
                        id_of(a) + ": " + a.name + " has become " + b.name + ", another message"});
    }
    if (is_elsewhere) {
      const Message& b = *same_name->second;
      found_.push_back(
          {Change::kMessageMoved, a.name + " moved from " + id_of(a) + " to " + id_of(b)});
      compare(a, b);
    } else if (same_id == ids_b.end()) {
      add(Change::kMessageGone, a, " is gone");
    }
  }
  for (const Message& b : other.messages) {
    if (ids_a.contains({b.extended, b.id}) || names_a.contains(b.name)) continue;
    add(Change::kMessageNew, b, " is new");
  }
  std::stable_sort(found_.begin(), found_.end(),
                   [](const Difference& x, const Difference& y) { return x.change < y.change; });
  return std::move(found_);
}

void Comparison::compare(const Message& a, const Message& b) {
  if (a.name != b.name) add(Change::kName, a, " is now called " + b.name);
  compare_frame(a, b);
  compare_signals(a, b);
  if (a.comment != b.comment) add(Change::kComment, b, ": the comment changed");
}

void Comparison::compare_frame(const Message& a, const Message& b) {
  if (a.length != b.length) {
    add(Change::kFrame, b,
        now_was(std::to_string(b.length), std::to_string(a.length) + " bytes long"));
  }
  if (a.fd != b.fd) {
    add(Change::kFrame, b, b.fd ? now_was("CAN FD", "classic") : now_was("classic", "CAN FD"));
  }
  const auto period = [](Duration d) {
    return d == Duration{} ? std::string{"not given"} : shortest(d.seconds() * 1e3) + " ms";
  };
  if (a.period != b.period) {
    add(Change::kTiming, b, ": its period" + now_was(period(b.period), period(a.period)));
  }
  const auto senders = [](const Message& m) {
    std::set<std::string> all{m.other_senders.begin(), m.other_senders.end()};
    all.insert(m.sender);
    return all;
  };
  if (senders(a) != senders(b)) {
    const auto listed = [&](const Message& m) {
      std::string out;
      for (const std::string& name : senders(m)) out += (out.empty() ? "" : ", ") + name;
      return out;
    };
    add(Change::kTiming, b, ": its sender" + now_was(listed(b), listed(a)));
  }
}

void Comparison::compare_signals(const Message& a, const Message& b) {
  const auto names_a = by_name(a), names_b = by_name(b);
  std::vector<const Signal*> gone, fresh;
  for (const Signal& x : a.signals) {
    const auto y = names_b.find(x.name);
    if (y == names_b.end()) {
      gone.push_back(&x);
    } else {
      compare(a, x, b, *y->second);
    }
  }
  for (const Signal& y : b.signals) {
    if (!names_a.contains(y.name)) fresh.push_back(&y);
  }
  one_sided(a, std::move(gone), b, std::move(fresh));
}

// Signals with the same bits and values under another name were renamed, in their order.
void Comparison::one_sided(const Message& a, std::vector<const Signal*> gone, const Message& b,
                           std::vector<const Signal*> fresh) {
  const auto bits = [](const Message& m, const Signal& s) {
    const SignalLayout& l = s.layout;
    return std::tuple{l.start, l.length, l.order, l.number, l.scale, l.offset, presence(m, s)};
  };
  std::multimap<decltype(bits(a, *gone[0])), const Signal*> unnamed;
  for (const Signal* y : fresh) unnamed.insert({bits(b, *y), y});
  std::set<const Signal*> renamed;
  for (const Signal* x : gone) {
    const auto y = unnamed.find(bits(a, *x));
    if (y == unnamed.end()) {
      add(Change::kSignalGone, b, ": " + x->name + " is gone");
      continue;
    }
    add(Change::kName, b, ": " + x->name + " is now called " + y->second->name);
    compare(a, *x, b, *y->second);
    renamed.insert(y->second);
    unnamed.erase(y);
  }
  for (const Signal* y : fresh) {
    if (!renamed.contains(y)) add(Change::kSignalNew, b, ": " + y->name + " is new");
  }
}

void Comparison::compare(const Message& a, const Signal& x, const Message& b, const Signal& y) {
  compare_reading(a, x, b, y);
  const auto range = [](const SignalLayout& l) {
    return l.min < l.max ? "[" + shortest(l.min) + "|" + shortest(l.max) + "]" : "not given";
  };
  if (range(x.layout) != range(y.layout)) {
    add(Change::kRange, b, ": the range of " + y.name + now_was(range(y.layout), range(x.layout)));
  }
  compare_value_names(b, x, y);
  if (x.unit != y.unit) {
    add(Change::kUnit, b, ": the unit of " + y.name + now_was(quoted(y.unit), quoted(x.unit)));
  }
  if (x.comment != y.comment) add(Change::kComment, b, ": the comment of " + y.name + " changed");
}

void Comparison::compare_reading(const Message& a, const Signal& x, const Message& b,
                                 const Signal& y) {
  const SignalLayout &l = x.layout, &k = y.layout;
  std::vector<std::string> how;
  const auto whole = [](unsigned v) { return std::to_string(v); };
  if (l.length != k.length) {
    how.push_back((l.length < k.length ? " grew from " : " shrank from ") + whole(l.length) +
                  " to " + whole(k.length) + " bits");
  }
  if (l.start != k.start) {
    how.push_back(" moved from bit " + whole(l.start) + " to " + whole(k.start));
  }
  if (l.order != k.order) how.push_back(now_was(name_of(k.order), name_of(l.order)));
  if (l.number != k.number) how.push_back(now_was(name_of(k.number), name_of(l.number)));
  if (l.scale != k.scale) {
    how.push_back(" has the scale " + shortest(k.scale) + ", had " + shortest(l.scale));
  }
  if (l.offset != k.offset) {
    how.push_back(" has the offset " + shortest(k.offset) + ", had " + shortest(l.offset));
  }
  const std::string was = presence(a, x), now = presence(b, y);
  if (was != now) how.push_back(" is now present " + now + ", was " + was);
  if (how.empty()) return;
  std::string text = ": " + y.name;
  for (std::size_t i = 0; i < how.size(); ++i) text += (i == 0 ? "" : ";") + how[i];
  const Example forth = misreading(x, y), back = misreading(y, x);
  const bool is_forth = forth.written != forth.read;
  add(Change::kSignalReread, b,
      text + (is_forth ? reported(forth, x.unit) : reported(back, y.unit)));
}

void Comparison::compare_value_names(const Message& b, const Signal& x, const Signal& y) {
  std::map<std::int64_t, std::pair<std::string, std::string>> names;
  for (const ValueName& v : x.values) names[v.value].first = v.name;
  for (const ValueName& v : y.values) names[v.value].second = v.name;
  std::string text;
  std::size_t count = 0;
  for (const auto& [value, both] : names) {
    const auto& [was, now] = both;
    if (was == now || ++count > kMostValues) continue;
    text += (text.empty() ? "" : ";") + std::string{" value "} + std::to_string(value) +
            (now.empty()   ? " is no longer " + quoted(was)
             : was.empty() ? " is now " + quoted(now)
                           : now_was(quoted(now), quoted(was)));
  }
  if (count > kMostValues) text += "; " + std::to_string(count - kMostValues) + " more";
  if (!text.empty()) add(Change::kValueNames, b, ": " + y.name + ":" + text);
}

}  // namespace

Severity severity_of(Change change) {
  switch (change) {
    case Change::kIdReused:
    case Change::kSignalReread:
      return Severity::kMisread;
    case Change::kMessageGone:
    case Change::kMessageMoved:
    case Change::kMessageNew:
    case Change::kFrame:
    case Change::kSignalGone:
    case Change::kSignalNew:
      return Severity::kMissing;
    case Change::kRange:
    case Change::kTiming:
    case Change::kValueNames:
    case Change::kUnit:
    case Change::kName:
    case Change::kComment:
      return Severity::kMeaning;
  }
  return Severity::kMeaning;
}

const char* name_of(Severity severity) {
  constexpr std::array<const char*, 3> kNames{"misread", "missing", "meaning"};
  return kNames[static_cast<std::size_t>(severity)];
}

std::vector<Difference> differences(const Database& one, const Database& other) {
  return Comparison{}.run(one, other);
}

}  // namespace pitwall::can

// SPDX-License-Identifier: Apache-2.0
#include "protocol/can/database.hpp"

#include <algorithm>
#include <bit>
#include <limits>
#include <numeric>

namespace pitwall::can {
namespace {

struct Fnv1a {
  std::uint64_t hash = 0xcbf29ce484222325;

  void byte(std::uint8_t b) { hash = (hash ^ b) * 0x100000001b3; }
  void number(std::uint64_t v) {
    for (unsigned i = 0; i < 8; ++i) byte(static_cast<std::uint8_t>(v >> 8 * i));
  }
  void real(double v) { number(std::bit_cast<std::uint64_t>(v + 0.0)); }
  void text(std::string_view t) {
    for (const char c : t) byte(static_cast<std::uint8_t>(c));
    byte(0);
  }
};

void add_signal(Fnv1a& sum, const Message& message, const Signal& s) {
  const SignalLayout& l = s.layout;
  sum.text(s.name);
  sum.number(l.start);
  sum.number(l.length);
  sum.number(static_cast<std::uint64_t>(l.order));
  sum.number(static_cast<std::uint64_t>(l.number));
  for (const double v : {l.scale, l.offset, l.min, l.max}) sum.real(v);
  sum.text(s.selector ? message.signals[*s.selector].name : "");
  for (const SelectorRange& r : s.when) {
    sum.number(r.low);
    sum.number(r.high);
  }
}

bool is_claimed(const BitMap& map, std::size_t bit) { return (map[bit / 8] >> bit % 8 & 1U) != 0; }

std::optional<std::size_t> first_shared_bit(const BitMap& a, const BitMap& b) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    const auto both = static_cast<std::uint8_t>(a[i] & b[i]);
    if (both != 0) return 8 * i + static_cast<std::size_t>(std::countr_zero(both));
  }
  return std::nullopt;
}

void claim(BitMap& map, const BitMap& more) {
  for (std::size_t i = 0; i < map.size(); ++i) {
    map[i] = static_cast<std::uint8_t>(map[i] | more[i]);
  }
}

void release(BitMap& map, const BitMap& gone) {
  for (std::size_t i = 0; i < map.size(); ++i) {
    map[i] = static_cast<std::uint8_t>(map[i] & ~gone[i]);
  }
}

// Two signals can be present together unless some selector above both tells them apart. So, below
// each selector, whatever hangs on one signal must keep off the bits of whatever hangs on another
// one whose selector values are met at the same time.
class OverlapSearch {
 public:
  explicit OverlapSearch(const Message& m) : m_(m), groups_(m.signals.size() + 1) {
    for (std::size_t i = 0; i < m.signals.size(); ++i) {
      own_.push_back(occupied_bits(m.signals[i].layout));
      groups_[group_of(m.signals[i])].push_back(i);
    }
    all_ = own_;
    std::vector<std::size_t> order(m.signals.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::vector<std::uint8_t> depth;
    for (const Signal& s : m.signals) depth.push_back(selectors_above(m, s).value_or(0));
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return depth[a] > depth[b]; });
    for (const std::size_t i : order) {
      if (m.signals[i].selector) claim(all_[*m.signals[i].selector], all_[i]);
    }
  }

  std::optional<Problem> run() const {
    for (std::size_t g = 0; g < groups_.size(); ++g) {
      for (const std::size_t i : groups_[g]) {
        if (!m_.signals[i].selector) continue;
        if (const auto bit = first_shared_bit(own_[g], all_[i])) return problem(g, below(i, *bit));
      }
      if (const auto found = among(groups_[g])) return found;
    }
    return std::nullopt;
  }

 private:
  struct Span {
    std::uint64_t low = 0, high = 0;
    std::size_t signal = 0;
  };

  std::size_t group_of(const Signal& s) const { return s.selector.value_or(m_.signals.size()); }

  // When the signals of a group are present, each without overlapping itself, by their beginnings.
  std::vector<Span> spans_of(const std::vector<std::size_t>& group) const {
    std::vector<Span> spans;
    for (const std::size_t i : group) {
      std::vector<SelectorRange> when = m_.signals[i].when;
      if (!m_.signals[i].selector) when = {{0, std::numeric_limits<std::uint64_t>::max()}};
      std::sort(when.begin(), when.end(),
                [](const SelectorRange& a, const SelectorRange& b) { return a.low < b.low; });
      const std::size_t first = spans.size();
      for (const SelectorRange& r : when) {
        if (spans.size() > first && r.low <= spans.back().high) {
          spans.back().high = std::max(spans.back().high, r.high);
        } else {
          spans.push_back({r.low, r.high, i});
        }
      }
    }
    std::stable_sort(spans.begin(), spans.end(),
                     [](const Span& a, const Span& b) { return a.low < b.low; });
    return spans;
  }

  std::optional<Problem> among(const std::vector<std::size_t>& group) const {
    const auto ends_later = [](const Span& a, const Span& b) { return a.high > b.high; };
    BitMap taken{};
    std::vector<Span> present;  // a heap: the next to end is in front
    for (const Span& s : spans_of(group)) {
      while (!present.empty() && present.front().high < s.low) {
        release(taken, all_[present.front().signal]);
        std::pop_heap(present.begin(), present.end(), ends_later);
        present.pop_back();
      }
      if (const auto bit = first_shared_bit(taken, all_[s.signal])) {
        for (const Span& p : present) {
          if (!is_claimed(all_[p.signal], *bit)) continue;
          return problem(below(p.signal, *bit), below(s.signal, *bit));
        }
      }
      claim(taken, all_[s.signal]);
      present.push_back(s);
      std::push_heap(present.begin(), present.end(), ends_later);
    }
    return std::nullopt;
  }

  // The signal that owns the bit: this one or one that hangs on it.
  std::size_t below(std::size_t at, std::size_t bit) const {
    while (!is_claimed(own_[at], bit)) {
      const auto& group = groups_[at];
      at = *std::find_if(group.begin(), group.end(),
                         [&](std::size_t i) { return is_claimed(all_[i], bit); });
    }
    return at;
  }

  Problem problem(std::size_t a, std::size_t b) const {
    const Signal &x = m_.signals[std::min(a, b)], &y = m_.signals[std::max(a, b)];
    return {y.place, "signal " + y.name + " overlaps signal " + x.name + " defined at " + x.place};
  }

  const Message& m_;
  std::vector<BitMap> own_, all_;                 // all: with what hangs on it
  std::vector<std::vector<std::size_t>> groups_;  // by selector; the last: always present
};

std::optional<Problem> equal_names(const Message& m) {
  std::vector<const Signal*> sorted;
  for (const Signal& s : m.signals) sorted.push_back(&s);
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const Signal* a, const Signal* b) { return a->name < b->name; });
  for (std::size_t i = 1; i < sorted.size(); ++i) {
    const Signal &x = *sorted[i - 1], &y = *sorted[i];
    if (x.name != y.name) continue;
    return Problem{y.place, "signal " + y.name + " is already defined at " + x.place};
  }
  return std::nullopt;
}

// Knuth's multiplicative hash.
std::size_t hash_of(std::uint32_t id) { return id * 0x9E3779B1U >> 7U; }

}  // namespace

const Signal* Message::find(std::string_view signal_name) const {
  const auto index = index_of(signal_name);
  return index ? &signals[*index] : nullptr;
}

std::optional<std::size_t> Message::index_of(std::string_view signal_name) const {
  for (std::size_t i = 0; i < signals.size(); ++i) {
    if (signals[i].name == signal_name) return i;
  }
  return std::nullopt;
}

const Message* Database::find(std::uint32_t id, bool extended) const {
  const auto before = [](const Message& m, const auto& key) {
    return std::pair{m.extended, m.id} < key;
  };
  const std::pair key{extended, id};
  const auto at = std::lower_bound(messages.begin(), messages.end(), key, before);
  return at != messages.end() && at->id == id && at->extended == extended ? &*at : nullptr;
}

const Message* Database::find(std::string_view message_name) const {
  for (const Message& m : messages) {
    if (m.name == message_name) return &m;
  }
  return nullptr;
}

std::optional<std::string_view> Database::attribute(std::string_view attribute_name,
                                                    AttributeOwner owner,
                                                    std::span<const Attribute> own) const {
  for (auto a = own.rbegin(); a != own.rend(); ++a) {
    if (a->name == attribute_name) return a->value;
  }
  for (const AttributeDefinition& d : definitions) {
    if (d.name == attribute_name && d.owner == owner && d.by_default) return *d.by_default;
  }
  return std::nullopt;
}

MessageIndex::MessageIndex(const Database& database) : standard_(kMaxStandardId + 1) {
  std::size_t extended = 0;
  for (const Message& m : database.messages) {
    if (m.extended) ++extended;
    if (!m.extended) standard_[m.id] = &m;
  }
  extended_.resize(std::bit_ceil(2 * extended + 1));
  for (const Message& m : database.messages) {
    if (!m.extended) continue;
    std::size_t at = hash_of(m.id) & (extended_.size() - 1);
    while (extended_[at].message != nullptr) at = (at + 1) & (extended_.size() - 1);
    extended_[at] = {m.id, &m};
  }
}

const Message* MessageIndex::find(std::uint32_t id, bool extended) const {
  if (!extended) return id <= kMaxStandardId ? standard_[id] : nullptr;
  std::size_t at = hash_of(id) & (extended_.size() - 1);
  while (extended_[at].message != nullptr && extended_[at].id != id) {
    at = (at + 1) & (extended_.size() - 1);
  }
  return extended_[at].message;
}

std::optional<std::uint8_t> selectors_above(const Message& m, const Signal& signal) {
  std::uint8_t depth = 0;
  for (const Signal* s = &signal; s->selector; s = &m.signals[*s->selector]) {
    if (++depth > kMaxSelectors) return std::nullopt;
  }
  return depth;
}

std::uint64_t fingerprint(const Database& database) {
  Fnv1a sum;
  for (const Message& m : database.messages) {
    sum.text(m.name);
    sum.number(m.id);
    sum.number((m.extended ? 1U : 0U) | (m.fd ? 2U : 0U));
    sum.number(m.length);
    std::vector<const Signal*> ordered;
    for (const Signal& s : m.signals) ordered.push_back(&s);
    std::sort(ordered.begin(), ordered.end(),
              [](const Signal* a, const Signal* b) { return a->name < b->name; });
    for (const Signal* s : ordered) add_signal(sum, m, *s);
  }
  return sum.hash;
}

std::optional<Problem> contradiction(const Message& m) {
  for (const Signal& s : m.signals) {
    if (fits(s.layout, m.length)) continue;
    return Problem{s.place, "signal " + s.name + " lies outside the " + std::to_string(m.length) +
                                " bytes of message " + m.name};
  }
  if (auto problem = equal_names(m)) return problem;
  return OverlapSearch{m}.run();
}

}  // namespace pitwall::can

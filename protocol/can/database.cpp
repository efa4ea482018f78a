// SPDX-License-Identifier: Apache-2.0
#include "protocol/can/database.hpp"

#include <algorithm>
#include <bit>

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

bool disjoint(const std::vector<SelectorRange>& a, const std::vector<SelectorRange>& b) {
  for (const SelectorRange& x : a) {
    for (const SelectorRange& y : b) {
      if (x.low <= y.high && y.low <= x.high) return false;
    }
  }
  return true;
}

// True where some selector above both never lets them be present together.
bool exclusive(const Message& m, const Signal& a, const Signal& b) {
  for (const Signal* x = &a; x->selector; x = &m.signals[*x->selector]) {
    for (const Signal* y = &b; y->selector; y = &m.signals[*y->selector]) {
      if (*x->selector == *y->selector && disjoint(x->when, y->when)) return true;
    }
  }
  return false;
}

bool overlap(const BitMap& a, const BitMap& b) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    if ((a[i] & b[i]) != 0) return true;
  }
  return false;
}

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

std::optional<std::uint8_t> selectors_above(const Message& m, const Signal& signal) {
  constexpr std::uint8_t kMost = 64;  // a frame cannot hold more that differ
  std::uint8_t depth = 0;
  for (const Signal* s = &signal; s->selector; s = &m.signals[*s->selector]) {
    if (++depth > kMost) return std::nullopt;
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
  std::vector<BitMap> bits;
  bits.reserve(m.signals.size());
  for (const Signal& s : m.signals) {
    if (!fits(s.layout, m.length)) {
      return Problem{s.place, "signal " + s.name + " lies outside the " + std::to_string(m.length) +
                                  " bytes of message " + m.name};
    }
    bits.push_back(occupied_bits(s.layout));
  }
  for (std::size_t b = 0; b < m.signals.size(); ++b) {
    for (std::size_t a = 0; a < b; ++a) {
      const Signal &x = m.signals[a], &y = m.signals[b];
      if (x.name == y.name) {
        return Problem{y.place, "signal " + y.name + " is already defined at " + x.place};
      }
      if (overlap(bits[a], bits[b]) && !exclusive(m, x, y)) {
        return Problem{
            y.place, "signal " + y.name + " overlaps signal " + x.name + " defined at " + x.place};
      }
    }
  }
  return std::nullopt;
}

}  // namespace pitwall::can

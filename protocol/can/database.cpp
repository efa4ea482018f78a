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

std::size_t Database::count(FindingSeverity severity) const {
  const auto is_one = [&](const Finding& f) { return severity_of(f.kind) == severity; };
  return static_cast<std::size_t>(std::count_if(findings.begin(), findings.end(), is_one)) +
         findings_left_off[static_cast<std::size_t>(severity)];
}

std::vector<const Finding*> worst_first(const Database& database) {
  std::vector<const Finding*> out;
  for (const Finding& f : database.findings) out.push_back(&f);
  std::stable_sort(out.begin(), out.end(),
                   [](const Finding* a, const Finding* b) { return a->kind < b->kind; });
  return out;
}

std::optional<Problem> refusal_of(const Database& database) {
  const std::size_t errors = database.count(FindingSeverity::kError);
  if (errors == 0) return std::nullopt;
  const Finding& worst = *worst_first(database).front();
  const std::string more = " (and " + std::to_string(errors - 1) + " more)";
  return Problem{worst.place, errors == 1 ? worst.what : worst.what + more};
}

}  // namespace pitwall::can

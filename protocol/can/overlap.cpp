// SPDX-License-Identifier: Apache-2.0
#include "protocol/can/overlap.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <numeric>
#include <set>
#include <utility>

namespace pitwall::can {
namespace {

// Of a file that is made to take long; a search for the owners of a bit looks at a few signals.
constexpr std::size_t kMaxLookedAt = 10'000'000;

// Two signals can be present together unless some selector above both tells them apart. So, below
// each selector, whatever hangs on one signal must keep off the bits of whatever hangs on another
// one whose selector values are met at the same time.
class OverlapSearch {
 public:
  explicit OverlapSearch(const Message& m)
      : m_(m), groups_(m.signals.size() + 1), below_(m.signals.size()), claims_(bits()) {
    for (std::size_t i = 0; i < m.signals.size(); ++i) {
      groups_[group_of(m.signals[i])].push_back(i);
    }
    std::vector<std::size_t> order(m.signals.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::vector<std::uint8_t> depth;
    for (const Signal& s : m.signals) depth.push_back(selectors_above(m, s).value_or(0));
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return depth[a] > depth[b]; });
    for (const std::size_t i : order) {
      if (!m.signals[i].selector) continue;
      std::vector<bool>& above = below_[*m.signals[i].selector];
      above.resize(bits());
      for (const std::size_t bit : all_of(i)) above[bit] = true;
    }
  }

  std::vector<Overlap> run() {
    for (std::size_t g = 0; g < groups_.size(); ++g) {
      for (const std::size_t i : groups_[g]) {
        if (m_.signals[i].selector) compare_with_selector(g, i);
      }
      compare_among(g);
    }
    std::vector<Overlap> out;
    for (const auto& [second, first] : found_) out.push_back({first, second});
    return out;
  }

 private:
  struct Span {
    std::uint64_t low = 0, high = 0;
    std::size_t signal = 0;
  };
  // Who claims a bit the longest of those of its group that came so far.
  struct Claim {
    std::size_t group = kNone;
    std::uint64_t high = 0;
    std::size_t signal = 0;
  };

  std::size_t bits() const { return 8U * m_.length; }
  std::size_t group_of(const Signal& s) const { return s.selector.value_or(m_.signals.size()); }

  bool owns(std::size_t signal, std::size_t bit) const {
    const auto own = bits_of(m_.signals[signal].layout);
    return std::find(own.begin(), own.end(), bit) != own.end();
  }
  bool holds(std::size_t signal, std::size_t bit) const {
    return owns(signal, bit) || (!below_[signal].empty() && below_[signal][bit]);
  }
  // Its own bits and those of what hangs on it; may name a bit twice.
  std::vector<std::size_t> all_of(std::size_t signal) const {
    std::vector<std::size_t> out = bits_of(m_.signals[signal].layout);
    for (std::size_t bit = 0; bit < below_[signal].size(); ++bit) {
      if (below_[signal][bit]) out.push_back(bit);
    }
    return out;
  }

  void compare_with_selector(std::size_t selector, std::size_t signal) {
    for (const std::size_t bit : bits_of(m_.signals[selector].layout)) {
      if (!is_full() && holds(signal, bit)) add({selector}, owners(signal, bit));
    }
  }

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

  void compare_among(std::size_t group) {
    for (const Span& s : spans_of(groups_[group])) {
      for (const std::size_t bit : all_of(s.signal)) {
        Claim& c = claims_[bit];
        const bool is_shared = c.group == group && c.high >= s.low && c.signal != s.signal;
        if (is_shared && !is_full()) add(owners(c.signal, bit), owners(s.signal, bit));
        if (!is_shared || c.high < s.high) c = {group, s.high, s.signal};
      }
    }
  }

  // The signals that own the bit: this one and those that hang on it.
  std::vector<std::size_t> owners(std::size_t at, std::size_t bit) {
    std::vector<std::size_t> out, next{at};
    while (!next.empty()) {
      const std::size_t i = next.back();
      next.pop_back();
      if (owns(i, bit)) out.push_back(i);
      if (below_[i].empty() || !below_[i][bit]) continue;
      for (const std::size_t k : groups_[i]) next.push_back(k);
      looked_at_ += groups_[i].size();
    }
    return out;
  }

  bool is_full() const { return found_.size() >= kMaxOverlaps || looked_at_ >= kMaxLookedAt; }
  void add(const std::vector<std::size_t>& some, const std::vector<std::size_t>& others) {
    for (const std::size_t a : some) {
      for (const std::size_t b : others) {
        if (!is_full() && a != b) found_.insert({std::max(a, b), std::min(a, b)});
      }
    }
  }

  static constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

  const Message& m_;
  std::vector<std::vector<std::size_t>> groups_;         // by selector; the last: always present
  std::vector<std::vector<bool>> below_;                 // the bits of what hangs on each signal
  std::vector<Claim> claims_;                            // of each bit
  std::set<std::pair<std::size_t, std::size_t>> found_;  // the later one, the earlier one
  std::size_t looked_at_ = 0;
};

}  // namespace

std::vector<Overlap> overlaps(const Message& message) { return OverlapSearch{message}.run(); }

}  // namespace pitwall::can

// SPDX-License-Identifier: Apache-2.0
#include "protocol/can/parser/dbc_resolution.hpp"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include "protocol/can/overlap.hpp"

namespace pitwall::can {
namespace {

class Resolution {
 public:
  Resolution(Message& m, std::vector<DbcDraft::Mark>& marks)
      : m_(m), marks_(marks), is_out_(m.signals.size()) {}

  std::vector<Finding> run() {
    leave_out_outsiders();
    leave_out_equal_names();
    find_selectors();
    leave_out_circles();
    leave_out_dependents();
    drop();
    mark_overlaps();
    for (Signal& s : m_.signals) {
      s.depth = selectors_above(m_, s).value_or(0);
      m_.deepest = std::max(m_.deepest, s.depth);
      if (m_.is_on_frame()) s.plan = plan(s.layout);
    }
    return std::move(found_);
  }

 private:
  void leave_out(std::size_t i, FindingKind kind, std::string what) {
    const Signal& s = m_.signals[i];
    if (is_out_[i]) return;
    is_out_[i] = true;
    found_.push_back({kind, s.place, std::move(what), "the signal is left out", subject(s)});
  }
  std::string subject(const Signal& s) const { return m_.name + "." + s.name; }

  void leave_out_outsiders() {
    for (std::size_t i = 0; i < m_.signals.size(); ++i) {
      const Signal& s = m_.signals[i];
      if (fits(s.layout, m_.length)) continue;
      leave_out(i, FindingKind::kSignal,
                "signal " + s.name + " lies outside the " + std::to_string(m_.length) +
                    " bytes of message " + m_.name);
    }
  }

  void leave_out_equal_names() {
    std::vector<std::size_t> sorted;
    for (std::size_t i = 0; i < m_.signals.size(); ++i) {
      if (!is_out_[i]) sorted.push_back(i);
    }
    std::stable_sort(sorted.begin(), sorted.end(), [&](std::size_t a, std::size_t b) {
      return m_.signals[a].name < m_.signals[b].name;
    });
    std::size_t first = 0;
    for (std::size_t k = 1; k < sorted.size(); ++k) {
      const Signal &x = m_.signals[sorted[first]], &y = m_.signals[sorted[k]];
      if (x.name != y.name) {
        first = k;
        continue;
      }
      leave_out(sorted[k], FindingKind::kSignal,
                "signal " + y.name + " is already defined at " + x.place);
    }
  }

  void find_selectors() {
    std::vector<std::size_t> roots;
    for (std::size_t i = 0; i < m_.signals.size(); ++i) {
      m_.signals[i].is_selector = marks_[i].is_selector;
      if (m_.signals[i].is_selector && !marks_[i].value && !is_out_[i]) roots.push_back(i);
    }
    for (std::size_t i = 0; i < m_.signals.size(); ++i) {
      Signal& s = m_.signals[i];
      DbcDraft::Mark& mark = marks_[i];
      if (mark.selector) {
        s.selector = mark.selector;
        s.when = std::move(mark.ranges);
        m_.signals[*s.selector].is_selector = true;
      } else if (mark.value && roots.size() == 1) {
        s.selector = roots[0];
        s.when = {{*mark.value, *mark.value}};
      } else if (mark.value) {
        leave_out(i, FindingKind::kMultiplexing,
                  "signal " + s.name + ": message " + m_.name + " has " +
                      std::to_string(roots.size()) + " multiplexers that could be meant");
      }
    }
  }

  void leave_out_circles() {
    for (std::size_t i = 0; i < m_.signals.size(); ++i) {
      const Signal& s = m_.signals[i];
      if (selectors_above(m_, s)) continue;
      leave_out(i, FindingKind::kMultiplexing,
                "the multiplexers of signal " + s.name + " form a circle, or are more than " +
                    std::to_string(kMaxSelectors));
    }
  }

  // What hangs on a signal that is left out cannot say when it is present.
  void leave_out_dependents() {
    for (std::size_t i = 0; i < m_.signals.size(); ++i) {
      for (const Signal* s = &m_.signals[i]; !is_out_[i] && s->selector;
           s = &m_.signals[*s->selector]) {
        if (!is_out_[*s->selector]) continue;
        leave_out(i, FindingKind::kMultiplexing,
                  "the multiplexer " + m_.signals[*s->selector].name + " of signal " +
                      m_.signals[i].name + " is left out");
      }
    }
  }

  void drop() {
    std::vector<std::size_t> place(m_.signals.size());
    std::size_t kept = 0;
    for (std::size_t i = 0; i < m_.signals.size(); ++i) place[i] = is_out_[i] ? kept : kept++;
    if (kept == m_.signals.size()) return;
    for (std::size_t i = 0; i < m_.signals.size(); ++i) {
      Signal& s = m_.signals[i];
      if (is_out_[i]) continue;
      if (s.selector) s.selector = place[*s.selector];
      if (place[i] != i) m_.signals[place[i]] = std::move(s);
    }
    m_.signals.resize(kept);
  }

  // One finding for each signal that overlaps earlier ones.
  void mark_overlaps() {
    const std::vector<Overlap> all = overlaps(m_);
    for (std::size_t k = 0; k < all.size();) {
      const std::size_t begin = k;
      Signal &x = m_.signals[all[k].first], &y = m_.signals[all[k].second];
      y.is_flawed = true;
      for (; k < all.size() && all[k].second == all[begin].second; ++k) {
        m_.signals[all[k].first].is_flawed = true;
      }
      const std::size_t others = k - begin - 1;
      found_.push_back({FindingKind::kOverlap, y.place,
                        "signal " + y.name + " overlaps signal " + x.name + " defined at " +
                            x.place +
                            (others == 0 ? "" : " and " + std::to_string(others) + " more"),
                        "all are kept", subject(y)});
    }
    if (all.size() < kMaxOverlaps) return;
    found_.push_back(
        {FindingKind::kOverlap, m_.place,
         "message " + m_.name + " has " + std::to_string(kMaxOverlaps) + " overlaps or more",
         "no more were looked for", m_.name});
  }

  Message& m_;
  std::vector<DbcDraft::Mark>& marks_;
  std::vector<bool> is_out_;
  std::vector<Finding> found_;
};

}  // namespace

std::vector<Finding> resolve(Message& message, std::vector<DbcDraft::Mark>& marks) {
  return Resolution{message, marks}.run();
}

}  // namespace pitwall::can

// SPDX-License-Identifier: Apache-2.0
#include "basestation/alarms/notices.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "protocol/vocabulary/text.hpp"

namespace pitwall::alarms {
namespace {

constexpr double kPercent = 100.0;

// The number with so many digits after the point, and its unit.
std::string number(double value, int digits, const char* unit) {
  return formatted("%.*f %s", digits, value, unit);
}

std::string figures(const LinkEvidence& link) {
  std::string text = "silence " + number(link.silence.seconds(), 2, "s");
  if (!std::isnan(link.loss)) text += ", loss " + number(link.loss * kPercent, 0, "%");
  if (!std::isnan(link.round_trip_ms))
    text += ", round trip " + number(link.round_trip_ms, 0, "ms");
  return text;
}

std::string mode_of(const LinkEvidence& link) {
  return link.car_mode.empty() ? "not known" : std::string{link.car_mode};
}

std::string text_for(const LinkEvidence& link, bool lost) {
  if (lost) {
    return "Radio to our car is lost. Car, when last heard: " + mode_of(link) +
           ". If the silence lasts it makes a controlled stop by itself.";
  }
  return "Radio to our car is degraded, not lost. Car: " + mode_of(link) +
         ". It hears us and drives on; no action is asked.";
}

double larger(double a, double b) { return std::isnan(b) ? a : std::max(a, b); }

}  // namespace

std::string_view text_of(NoticeKind kind) {
  return kind == NoticeKind::kDegraded ? "degraded" : "restored";
}

void Notices::step(const LinkEvidence& link, Instant now) {
  using state::LinkState;
  const bool good = link.state == LinkState::kGood;
  if (link.state == LinkState::kNone || (good && !episode_)) return;
  if (!episode_) begin(now);
  note_worst(link);
  const bool lost_now = link.state == LinkState::kLost;
  if (!reported_ || (lost_now && !lost_)) tell_degraded(link, lost_now, now);
  if (!good) {
    good_since_.reset();
    return;
  }
  if (!good_since_) good_since_ = now;
  if (now - *good_since_ >= kSteadyFor) tell_restored(link, now);
}

void Notices::begin(Instant now) {
  episode_ = true;
  reported_ = lost_ = false;
  began_ = now;
  good_since_.reset();
  worst_loss_ = worst_round_trip_ms_ = 0.0;
  longest_silence_ = {};
}

void Notices::note_worst(const LinkEvidence& link) {
  worst_loss_ = larger(worst_loss_, link.loss);
  worst_round_trip_ms_ = larger(worst_round_trip_ms_, link.round_trip_ms);
  longest_silence_ = std::max(longest_silence_, link.silence);
}

// Once; a draft that turns out to be a loss says so, one that was sent stays what it said.
void Notices::tell_degraded(const LinkEvidence& link, bool lost, Instant now) {
  lost_ = lost_ || lost;
  if (!reported_) draft(NoticeKind::kDegraded, now);
  reported_ = true;
  Notice& notice = notices_.back();
  if (notice.fate != NoticeFate::kDraft) return;
  notice.text = text_for(link, lost);
  notice.evidence = figures(link);
  ++revision_;
}

void Notices::tell_restored(const LinkEvidence& link, Instant now) {
  Notice& notice = draft(NoticeKind::kRestored, now);
  notice.text = "Radio to our car is good again after " +
                number((*good_since_ - began_).seconds(), 1, "s") + ". Car: " + mode_of(link) + ".";
  notice.evidence = std::string{lost_ ? "was lost" : "was degraded, never lost"} +
                    "; longest silence " + number(longest_silence_.seconds(), 2, "s") +
                    ", worst loss " + number(worst_loss_ * kPercent, 0, "%") +
                    ", longest round trip " + number(worst_round_trip_ms_, 0, "ms");
  episode_ = false;
}

Notice& Notices::draft(NoticeKind kind, Instant now) {
  notices_.push_back({.id = ++ids_, .kind = kind, .at = now, .text = {}, .evidence = {}, .by = {}});
  if (notices_.size() > kKept) notices_.pop_front();
  ++revision_;
  return notices_.back();
}

Result<bool, Problem> Notices::decide(std::uint32_t id, NoticeFate fate, std::string_view by) {
  const auto wrong = [id](const char* what) {
    return Unexpected{Problem{"notice " + std::to_string(id), what}};
  };
  if (by.empty()) return wrong("who decides has a name");
  const auto found = std::find_if(notices_.begin(), notices_.end(),
                                  [id](const Notice& notice) { return notice.id == id; });
  if (found == notices_.end()) return wrong("there is none");
  if (found->fate != NoticeFate::kDraft) return wrong("was decided before");
  found->fate = fate;
  found->by = by;
  ++revision_;
  return true;
}

}  // namespace pitwall::alarms

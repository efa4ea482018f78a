// Drafts of messages to race control about the radio link: its state, since when, with which
// figures. They keep race control from slowing a rival because of a mere delay, and report when the
// link is good again.
//   in     state and figures of the link, mode of the car
//   out    drafts; one "degraded" and one "restored" for each episode in which the link is not good
//   invariants
//          an episode begins when the link leaves "good" and ends when it is good again for
//          kSteadyFor; changes in between go into the evidence of the draft, not into a new message
//   bound  the newest kKept
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <string_view>

#include "basestation/state/derived/link_state.hpp"
#include "basestation/state/known.hpp"
#include "protocol/vocabulary/result.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::alarms {

enum class NoticeKind : std::uint8_t { kDegraded, kRestored };
std::string_view text_of(NoticeKind kind);
enum class NoticeFate : std::uint8_t { kDraft, kReported, kDismissed };

struct Notice {
  std::uint32_t id = 0;
  NoticeKind kind = NoticeKind::kDegraded;
  Instant at{};
  std::string text, evidence;
  NoticeFate fate = NoticeFate::kDraft;
  std::string by;

  bool operator==(const Notice&) const = default;
};

struct LinkEvidence {
  state::LinkState state = state::LinkState::kNone;
  Duration silence{};
  double loss = kUnset, round_trip_ms = kUnset;
  std::string_view car_mode;  // as last received
};

class Notices {
 public:
  static constexpr std::size_t kKept = 100;
  static constexpr Duration kSteadyFor = seconds(2);

  void step(const LinkEvidence& link, Instant now);
  // Notes that a person has told race control, or that it is not needed; nothing is sent from here.
  Result<bool, Problem> decide(std::uint32_t id, NoticeFate fate, std::string_view by);

  const std::deque<Notice>& all() const { return notices_; }
  std::uint64_t revision() const { return revision_; }

 private:
  void begin(Instant now);
  void note_worst(const LinkEvidence& link);
  void tell_degraded(const LinkEvidence& link, bool lost, Instant now);
  void tell_restored(const LinkEvidence& link, Instant now);
  Notice& draft(NoticeKind kind, Instant now);

  std::deque<Notice> notices_;
  std::uint32_t ids_ = 0;
  std::uint64_t revision_ = 0;
  bool episode_ = false, reported_ = false, lost_ = false;
  Instant began_{};
  std::optional<Instant> good_since_;
  double worst_loss_ = 0.0, worst_round_trip_ms_ = 0.0;
  Duration longest_silence_{};
};

}  // namespace pitwall::alarms

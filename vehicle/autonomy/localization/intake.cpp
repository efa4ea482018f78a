// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/localization/intake.hpp"

#include <algorithm>
#include <cmath>

#include "protocol/vocabulary/check.hpp"

namespace pitwall::localization {
namespace {

constexpr double kRecentGaps = 2.0;    // gaps: longer ago a source is not in use any more
constexpr double kBeyondChance = 2.0;  // gates away: 8 sigmas or more
constexpr std::uint8_t kJumpsInRow = 2;

// Farther from what is predicted than its gate and chance together allow.
bool beyond_chance(const Evidence& e) {
  return e.residual > kBeyondChance * std::fmax(e.jump_min, e.jump_sigma_max);
}

}  // namespace

double Intake::bank_rad() const {
  return std::isfinite(around.road.bank_rad) ? around.road.bank_rad : 0.0;
}

void record_verdict(const Intake& in, Source source, std::uint8_t unit, Instant at, Gate gate,
                    double nis) {
  CHECK(in.out.verdicts.push({source, unit, gate, nis, (in.now - at).seconds()}));
  if (unit >= world::kGnssUnits) return;
  if (source == Source::kWheelSpeed) {
    in.state.wheels.verdict = gate;
  } else {
    Stream& stream = in.stream(source, unit);
    stream.verdict = gate;
    if (gate == Gate::kAccepted || gate == Gate::kStandby) stream.jumps_in_row = 0;
  }
  Tally& tally = in.state.tally[static_cast<std::size_t>(source)][unit];
  ++tally.by_gate[static_cast<std::size_t>(gate)];
  if (gate != Gate::kAccepted) return;
  tally.last_accepted = tally.ever_accepted ? std::max(tally.last_accepted, at) : at;
  tally.ever_accepted = true;
}

bool fuse(const Intake& in, Source source, const Measurement& m) {
  if (!in.state.started) return record_verdict(in, source, m.unit, m.at, Gate::kNotStarted), false;
  const auto innovation = insert(in.state.filter, in.filter, m);
  const Gate gate = !innovation            ? Gate::kTooOld
                    : innovation->accepted ? Gate::kAccepted
                                           : Gate::kOutlier;
  record_verdict(in, source, m.unit, m.at, gate, innovation ? innovation->nis : kUnset);
  return gate == Gate::kAccepted;
}

double gap_max_s(const CheckParams& p, Source source) {
  switch (source) {
    case Source::kPosition:
      return p.position_gap_max_s;
    case Source::kVelocity:
      return p.velocity_gap_max_s;
    case Source::kHeading:
    case Source::kAttitude:
      return p.heading_gap_max_s;
    case Source::kImu:
      return p.imu_gap_max_s;
    case Source::kWheelSpeed:
      return p.wheel_gap_max_s;
  }
  CHECK(false);
}

bool in_use(const Intake& in, Source source, std::size_t unit) {
  const Tally& t = in.tally(source, unit);
  const double recent_s = kRecentGaps * gap_max_s(in.params.checks, source);
  return t.ever_accepted && (in.now - t.last_accepted).seconds() <= recent_s;
}

bool other_in_use(const Intake& in, Source source, std::size_t unit) {
  for (std::size_t u = 0; u < world::kGnssUnits; ++u)
    if (u != unit && in_use(in, source, u)) return true;
  return false;
}

void complete(const Intake& in, const Stream& stream, const Content& content, Instant at,
              Evidence& e) {
  e.age_s = (in.now - at).seconds();
  e.window_s = in.params.filter.window_s;
  // Whose stamps were all refused for so long has another clock now; its age is judged as well.
  const bool remembered = (in.now - stream.stamped_at).seconds() <= in.params.checks.rate_window_s;
  if (remembered) {
    e.after_newest_s = stream.stamps.after_newest_s(at);
    e.spacing_s = stream.stamps.spacing_s(at);
  }
  e.same_content = stream.has_content && stream.content == content;
  if (const Moment* moment = in.state.trail.newest()) e.speed_mps = moment->speed_mps;
}

void count_jump(const Intake& in, Stream& stream, bool beyond_chance) {
  if (in.params.off.has(world::Monitor::kInnovation)) return;
  if (stream.jumps_in_row < kJumpsInRow) ++stream.jumps_in_row;
  if (beyond_chance || stream.jumps_in_row == kJumpsInRow)
    stream.seen.add(world::Monitor::kInnovation);
}

Gate admit(const Intake& in, const Evidence& evidence, std::uint8_t unit, const Content& content,
           Instant at) {
  const CheckParams& checks = in.params.checks;
  const Judged judged = judge(evidence, checks, in.params.off);
  if (!evidence.known_unit) return judged.gate;
  Stream& stream = in.stream(evidence.source, unit);
  stream.seen = judged.seen;
  if (judged.seen.has(world::Monitor::kInnovation)) {
    stream.seen.bits &= ~(1U << static_cast<unsigned>(world::Monitor::kInnovation));
    count_jump(in, stream, beyond_chance(evidence));
  }
  stream.trust.receive(
      std::max(checks.rate_window_s, kRecentGaps * gap_max_s(checks, evidence.source)), in.now);
  const bool has_wrong_time = judged.gate == Gate::kFromTheFuture || judged.gate == Gate::kTooOld ||
                              judged.gate == Gate::kRanBack;
  if (!has_wrong_time && judged.gate != Gate::kRepeated) {
    if ((in.now - stream.stamped_at).seconds() > checks.rate_window_s) stream.stamps = {};
    stream.stamps.use(at);
    stream.stamped_at = in.now;
  }
  stream.content = content;
  stream.has_content = true;
  if (judged.gate != Gate::kAccepted) {
    stream.trust.refuse(checks);
    return judged.gate;
  }
  const bool alone = !other_in_use(in, evidence.source, unit);
  return stream.trust.admit(checks, alone, in.now) ? Gate::kAccepted : Gate::kProbation;
}

}  // namespace pitwall::localization

// Processing of one sample, from the checks to the verdict, as far as all sources share it.
// Internal to localization.
//   in     one sample and its context (Intake)
//   out    its verdict, reported and counted; an accepted sample is in the filter
//   invariants
//          an excluded sample changes only its verdict and its counts
//   cost   O(rows of the check table + window of the filter); no allocation
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "vehicle/autonomy/localization/localization.hpp"

namespace pitwall::localization {

struct Intake {
  const Params& params;
  const FilterParams& filter;  // of params; without gates if the bench disables them
  const Datum& datum;
  const Surroundings& around;
  world::SensorUse use;
  Instant now;
  State& state;
  Output& out;

  Stream& stream(Source source, std::uint8_t unit) const {
    return state.streams[static_cast<std::size_t>(source)][unit];
  }
  const Tally& tally(Source source, std::size_t unit) const {
    return state.tally[static_cast<std::size_t>(source)][unit];
  }
  double bank_rad() const;  // zero if the road is not known
};

void record_verdict(const Intake& in, Source source, std::uint8_t unit, Instant at, Gate gate,
                    double nis = kUnset);
// Inserts the measurement into the filter and records the verdict. Returns true if it was accepted.
bool fuse(const Intake& in, Source source, const Measurement& m);

// Longest allowed silence of a stream.
double gap_max_s(const CheckParams& params, Source source);
// Whether a sample of this source and unit was accepted recently.
bool in_use(const Intake& in, Source source, std::size_t unit);
// The same for the other unit.
bool other_in_use(const Intake& in, Source source, std::size_t unit);

// Adds to the evidence what the stream knows: spacing of stamps, repeated content, speed.
void complete(const Intake& in, const Stream& stream, const Content& content, Instant at,
              Evidence& evidence);
// Records that a sample of this stream was refused as a jump. kInnovation reports a jump beyond
// chance at once, others at the second consecutive one: a gate refuses a good sample about once an
// hour, so two consecutive ones of one stream are not chance.
void count_jump(const Intake& in, Stream& stream, bool beyond_chance);
// Checks a sample, updates the stream and its trust. Returns kAccepted, kProbation or the reason
// for the refusal.
Gate admit(const Intake& in, const Evidence& evidence, std::uint8_t unit, const Content& content,
           Instant at);

void take(const Intake& in, const world::ImuSample& sample);
void take(const Intake& in, const world::GnssPosition& p);
void take(const Intake& in, const world::GnssVelocity& v);
void take(const Intake& in, const world::GnssHeading& h);
void take(const Intake& in, const world::InsAttitude& a);
void take_wheels(const Intake& in, const world::VehicleSignals& car);

// Conversion of a sample into a measurement of the filter.
Measurement measurement(const Intake& in, const world::GnssPosition& p);
Measurement measurement(const Intake& in, const world::GnssHeading& h);

}  // namespace pitwall::localization

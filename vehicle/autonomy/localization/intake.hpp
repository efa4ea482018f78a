// Intake of samples: the steps from a sample to a verdict that all sources share. Internal to
// localization.
//   in     one sample and all that is known beside it (Intake)
//   out    its verdict, told and tallied; the filter has it if it was accepted
//   invariants
//          an excluded sample touches nothing but its verdict and its tally
//   cost   O(rows of the check table + window of the filter); no allocation
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "vehicle/autonomy/localization/localization.hpp"

namespace pitwall::localization {

struct Intake {
  const Params& params;
  const FilterParams& filter;  // of params, or without gates for the bench
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
  double bank_rad() const;  // zero where the road is not known
};

void record_verdict(const Intake& in, Source source, std::uint8_t unit, Instant at, Gate gate,
                    double nis = kUnset);
// Puts it into the filter and tells what became of it; true if it was taken in.
bool fuse(const Intake& in, Source source, const Measurement& m);

// How long a stream may be silent.
double gap_max_s(const CheckParams& params, Source source);
// Whether this unit's source was taken in lately.
bool in_use(const Intake& in, Source source, std::size_t unit);
// Whether the other one's was.
bool other_in_use(const Intake& in, Source source, std::size_t unit);

// Stamps, contents and speed: what a stream knows of its sample before it is judged.
void complete(const Intake& in, const Stream& stream, const Content& content, Instant at,
              Evidence& evidence);
// A sample of this stream was refused as a jump: kInnovation sees it at once where it is beyond
// chance, else with the second one in a row. A gate refuses a good sample about once an hour; two
// of one stream in a row are no chance.
void see_jump(const Intake& in, Stream& stream, bool beyond_chance);
// Judges, remembers and decides on trust: kAccepted, kProbation or the reason against it.
Gate admit(const Intake& in, const Evidence& evidence, std::uint8_t unit, const Content& content,
           Instant at);

void take(const Intake& in, const world::ImuSample& sample);
void take(const Intake& in, const world::GnssPosition& p);
void take(const Intake& in, const world::GnssVelocity& v);
void take(const Intake& in, const world::GnssHeading& h);
void take(const Intake& in, const world::InsAttitude& a);
void take_wheels(const Intake& in, const world::VehicleSignals& car);

// As the filter takes them.
Measurement measurement(const Intake& in, const world::GnssPosition& p);
Measurement measurement(const Intake& in, const world::GnssHeading& h);

}  // namespace pitwall::localization

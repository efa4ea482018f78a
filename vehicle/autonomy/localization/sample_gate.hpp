// Whether a sample may be believed by what it says alone: solved, finite, sure enough, and nothing
// that a car on a track cannot do or a receiver cannot mean. Timing and innovation are judged
// apart.
//   in     one sample
//   out    kAccepted or the first reason against it
//   units  as in world/sensor_input.hpp
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vehicle/autonomy/localization/localization.hpp"

namespace pitwall::localization {

Gate contents(const Params& params, const Datum& datum, const world::GnssPosition& p);
Gate contents(const world::GnssVelocity& v);
Gate contents(const Params& params, const world::GnssHeading& h);
Gate contents(const world::ImuSample& s);

}  // namespace pitwall::localization

// Properties of a sample that the check table judges: its form and its solution. Stamps, prediction
// and the other unit are added by intake.
//   in     one sample
//   out    Evidence with form and solution filled in
//   units  as in world/sensor_input.hpp
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "vehicle/autonomy/localization/checks/check_table.hpp"
#include "vehicle/autonomy/localization/datum.hpp"
#include "vehicle/autonomy/localization/params.hpp"
#include "vehicle/world/sensor_input.hpp"

namespace pitwall::localization {

Evidence evidence_of(const Params& params, const Datum& datum, const world::GnssPosition& p);
Evidence evidence_of(const Params& params, const Datum& datum, const world::GnssVelocity& v);
Evidence evidence_of(const Params& params, const Datum& datum, const world::GnssHeading& h);
Evidence evidence_of(const Params& params, const Datum& datum, const world::InsAttitude& a);
Evidence evidence_of(const Params& params, const Datum& datum, const world::ImuSample& s);

// How good a position of this type (NovAtel OEM7, position type) can be: 0 none, 1 single point,
// 2 differential or float, 3 fixed.
double rank_of(std::uint32_t position_type);

// The numbers that cannot be the same twice while the car moves.
using Content = std::array<double, 3>;
Content content_of(const world::GnssPosition& p);
Content content_of(const world::GnssVelocity& v);
Content content_of(const world::GnssHeading& h);
Content content_of(const world::InsAttitude& a);
Content content_of(const world::ImuSample& s);

}  // namespace pitwall::localization

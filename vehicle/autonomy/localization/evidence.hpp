// Facts about a sample for the check table: its form and its solution. intake.hpp adds stamps,
// prediction and the other unit.
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

// Rank of a position type (NovAtel OEM7): 0 none, 1 single point, 2 differential or float, 3 fixed.
double rank_of(std::uint32_t position_type);

// Values of a sample that cannot repeat while the car moves.
using Content = std::array<double, 3>;
Content content_of(const world::GnssPosition& p);
Content content_of(const world::GnssVelocity& v);
Content content_of(const world::GnssHeading& h);
Content content_of(const world::InsAttitude& a);
Content content_of(const world::ImuSample& s);

}  // namespace pitwall::localization

// Step sizes of the integration between two samples, common to both filters.
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace pitwall::localization {

inline constexpr double kStepMax_s = 0.02;  // longer intervals are divided
inline constexpr double kGapMax_s = 1.0;    // longer gaps are not integrated but add variance
inline constexpr double kGapSigma_m = 100.0;

}  // namespace pitwall::localization

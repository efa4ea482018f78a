// Integration step of both filters between two samples.
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace pitwall::localization {

inline constexpr double kStepMax_s = 0.02;  // of one integration step; longer gaps are divided
inline constexpr double kGapMax_s = 1.0;    // longer gaps are not integrated but widen the belief
inline constexpr double kGapSigma_m = 100.0;

}  // namespace pitwall::localization

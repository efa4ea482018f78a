// Comparison of log reading speed with python-can: the same file, the same machine, one after the
// other.
//   in     a log; a folder to write it to, once as candump and once as Vector ASC
//   out    frames per second of processor time of both (other load does not count), the best of
//          kReadings; python-can is timed inside its process, so its start-up does not count
//   errors Problem: python-can is missing or reads another number of frames
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>

#include "hil/replay/formats/can_log.hpp"
#include "protocol/vocabulary/result.hpp"

namespace pitwall::benchmarks {

inline constexpr int kReadings = 5;
inline constexpr double kLeastReadingTimes = 10.0;  // speed relative to python-can

struct ReadingSpeed {
  std::string format;
  double ours_per_s = 0.0, python_per_s = 0.0;
};
using ReadingSpeeds = std::array<ReadingSpeed, 2>;

Result<ReadingSpeeds, Problem> measure_reading(const replay::CanLog& log,
                                               const std::string& folder);

}  // namespace pitwall::benchmarks

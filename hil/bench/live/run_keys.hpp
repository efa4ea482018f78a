// Keys of car and base station for one run of the bench, of the kind whose sessions may be logged.
//   in     folder, which is made, and what an earlier run left in it is replaced; or the plan of a
//          live run with the folder of the keys that it was given, empty: new ones, worth nothing
//          later
//   out    car.keys and base.keys, readable by their owner only. Programs take keys of their own
//          user only, and in a guest the files of the host may be another's: then copies in memory
//   errors Problem with the path
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "hil/bench/live/live_plan.hpp"
#include "protocol/transport/file.hpp"
#include "protocol/vocabulary/result.hpp"

namespace pitwall::bench {

Result<bool, Problem> make_run_keys(const std::string& folder);

struct RunKeys {
  std::string folder;
  std::optional<transport::TemporaryFolder> memory{};  // which goes with the value
};
Result<RunKeys, Problem> keys_of_run(const LivePlan& plan, const std::string& given);

}  // namespace pitwall::bench

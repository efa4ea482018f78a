// Keys of car and base station for one run of the bench, of the kind whose sessions may be logged.
//   in     make_run_keys(): a folder, which is created; keys of an earlier run in it are replaced.
//          keys_of_run(): the plan of a live run and the folder of the given keys; if that is
//          empty, new keys are made for this run only
//   out    car.keys and base.keys, readable by their owner only. Programs accept only keys of their
//          own user. In a guest the files of the host may belong to another user; the keys are then
//          in a folder in memory
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
  std::optional<transport::TemporaryFolder> memory{};  // removed together with this value
};
Result<RunKeys, Problem> keys_of_run(const LivePlan& plan, const std::string& given);

}  // namespace pitwall::bench

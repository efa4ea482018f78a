// Keys of car and base station for one run of the bench: new ones each time, worth nothing later.
//   in     folder; is made, and what an earlier run left in it is replaced
//   out    car.keys and base.keys, readable by their owner only
//   errors Problem with the path
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "protocol/vocabulary/result.hpp"

namespace pitwall::bench {

Result<bool, Problem> make_run_keys(const std::string& folder);

}  // namespace pitwall::bench

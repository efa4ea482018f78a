// SPDX-License-Identifier: Apache-2.0
#include "hil/verbs/lockstep_speed.hpp"

#include "hil/bench/lockstep.hpp"
#include "protocol/transport/clock.hpp"

namespace pitwall::verbs {

Result<double, Problem> times_real_time(const bench::Loaded& loaded, bool with_log) {
  recording::Sink sink;
  if (with_log) sink = [](std::span<const std::uint8_t>) { return true; };
  const Duration before = transport::thread_time();
  const auto result = bench::run_lockstep(loaded.scenario, loaded.setup, {.log = sink});
  if (!result) return Unexpected{result.error()};
  return loaded.scenario.duration.seconds() / (transport::thread_time() - before).seconds();
}

}  // namespace pitwall::verbs

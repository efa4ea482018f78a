// A car whose second receiver is a VectorNav drives by it: its bytes are another language, the
// meaning is the same.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "hil/bench/loading.hpp"
#include "hil/bench/lockstep/lockstep.hpp"

namespace pitwall::bench {
namespace {

TEST(VectorNavInLockstep, TheCarKnowsWhereItIsByItAlone) {
  auto loaded = load(std::string(PITWALL_SOURCE_DIR) + "/hil/scenarios/gnss_one_unit_out.yaml",
                     PITWALL_SOURCE_DIR);
  ASSERT_TRUE(loaded) << to_string(loaded.error());
  loaded->scenario.duration = seconds(30);
  loaded->scenario.expect.clear();
  // From here on the VectorNav alone knows where the car is.
  scenario::Fault silent;
  silent.kind = "gnss_no_solution";
  silent.at = seconds(20);
  silent.lasts = seconds(10);
  loaded->scenario.faults = {silent};
  loaded->setup.params.receivers[1].kind = world::ReceiverKind::kVectorNav;
  loaded->setup.params.localization.units[1].baseline_yaw_rad = 0.0;
  double error_max_m = 0.0;
  bool drives = false;
  LockstepOptions options;
  options.watch = [&](const pipeline::Outputs& out, const Rig& rig, Instant now) {
    drives = rig.truth().speed_mps > 20.0;
    if (now < Instant{} + seconds(12)) return;
    error_max_m = std::max(
        error_max_m, std::hypot(out.ego.x_m - rig.truth().x_m, out.ego.y_m - rig.truth().y_m));
  };
  const auto result = run_lockstep(loaded->scenario, loaded->setup, options);
  ASSERT_TRUE(result) << to_string(result.error());
  EXPECT_TRUE(drives);
  EXPECT_LT(error_max_m, 0.2);
}

}  // namespace
}  // namespace pitwall::bench

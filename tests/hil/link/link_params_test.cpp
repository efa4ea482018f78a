// SPDX-License-Identifier: Apache-2.0
#include "hil/link/link_params.hpp"

#include <gtest/gtest.h>

namespace pitwall::link {
namespace {

TEST(LinkParams, ThePresetHasTheLossAndTheFadesOfItsName) {
  for (const double loss : {0.1, 0.3, 0.5, 0.7}) {
    const LinkParams params = bursty(loss, milliseconds(120), 32'000.0, milliseconds(15));
    EXPECT_NEAR(params.fades.mean_loss(), loss, 1e-6);
    EXPECT_EQ(params.fades.mean_bad, milliseconds(120));
    EXPECT_EQ(params.rate_bytes_per_s, 32'000.0);
    EXPECT_EQ(params.delay, milliseconds(15));
  }
  EXPECT_EQ(bursty(0.0, milliseconds(120), 0.0, {}).fades.mean_loss(), 0.0);
}

TEST(LinkParams, TheMeanLossCountsBothStates) {
  const Fades fades{milliseconds(280), milliseconds(120), 0.02, 0.9};
  EXPECT_NEAR(fades.mean_loss(), 0.7 * 0.02 + 0.3 * 0.9, 1e-12);
  EXPECT_EQ(Fades{}.mean_loss(), 0.0);
}

}  // namespace
}  // namespace pitwall::link

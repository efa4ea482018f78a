// SPDX-License-Identifier: Apache-2.0
#include "vehicle/guardian/record.hpp"

#include <gtest/gtest.h>

#include <set>
#include <string>

namespace pitwall::guardian {
namespace {

template <class E>
std::set<std::string> texts(std::size_t count) {
  std::set<std::string> all;
  for (std::size_t i = 0; i < count; ++i) all.insert(text_of(static_cast<E>(i)));
  return all;
}

TEST(Record, EveryModeCauseAndGuidanceHasAWordOfItsOwn) {
  EXPECT_EQ(texts<Mode>(kModes).size(), kModes);
  EXPECT_EQ(texts<Cause>(kCauses).size(), kCauses);
  EXPECT_EQ(texts<Guidance>(kGuidances).size(), kGuidances);
}

TEST(Record, TheGuardianDrivesInTwoModes) {
  for (std::size_t i = 0; i < kModes; ++i) {
    const auto mode = static_cast<Mode>(i);
    EXPECT_EQ(drives(mode), mode == Mode::kDriving || mode == Mode::kHalted) << text_of(mode);
  }
}

TEST(Record, NothingIsAllowedUntilItIsSaid) {
  const CarRecord record;
  EXPECT_EQ(record.run, 0u);
  EXPECT_FALSE(record.armed || record.sends || record.reset);
  EXPECT_TRUE(record.stop.points.empty());
  EXPECT_FALSE(drives(Status{}.mode));
}

}  // namespace
}  // namespace pitwall::guardian

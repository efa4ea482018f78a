// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/endpoint/path_choice.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "tests/support/instants.hpp"

namespace pitwall::telemetry {
namespace {

constexpr UdpAddress kBase[] = {{0x0A000002, 5'000}, {0x0A000002, 5'001}};

// A car of two paths that knows where the base is.
class CarOfPaths {
 public:
  explicit CarOfPaths(std::uint8_t paths = 2) : random_(1) {
    AssociationConfig config;
    config.keys = {.role = Role::kCar, .own = make_identity(random_), .peer = {}};
    config.keys.peer = make_identity(random_).public_key;
    config.greeting.boot = 1;
    config.peer = {kBase[0], kBase[1]};
    config.paths = paths;
    association = std::make_unique<Association>(config, random_);
    for (std::uint8_t i = 0; i < paths; ++i) {
      lanes.emplace_back(BudgetParams{});
      (void)lanes.back().budget.room_for_all(at_ms(-5'000));  // full by the time zero
    }
  }

  FixedVector<PacketPlan, kPaths> plans(PathPolicy policy, Instant now, bool between = false,
                                        bool in_doubt = false) const {
    return PathChoice{*association, lanes, policy, in_doubt}.plans(between, now);
  }
  FixedVector<PacketPlan, kPaths> plans_at_once(PathPolicy policy, Instant now) const {
    return PathChoice{*association, lanes, policy, false, true}.plans(true, now);
  }
  // Leaves so little that not even a small packet goes.
  void exhaust(PathId path, Instant now) {
    lanes[path].spend(lanes[path].budget.room_for_safety(now),
                      lanes[path].budget.room_for_safety(now), now);
  }

  std::unique_ptr<Association> association;
  std::vector<PathLane> lanes;

 private:
  SeededRandomness random_;
};

TEST(PathChoice, OnePathHasOnePlan) {
  const CarOfPaths car(1);
  const auto plans = car.plans(PathPolicy::kDuplicate, at_ms(0));
  ASSERT_EQ(plans.size(), 1U);
  EXPECT_EQ(plans[0].paths, bit_of(0));
  EXPECT_FALSE(plans[0].only_safety || plans[0].between || plans[0].trial);
  EXPECT_EQ(plans[0].safety_room + kAround, car.lanes[0].budget.room_for_safety(at_ms(0)));
}

// A packet for both has the rate of the slower one, as it is at present.
TEST(PathChoice, APlanHasTheRateOfItsNarrowestPath) {
  CarOfPaths car;
  const double whole = car.lanes[0].budget.present_rate();
  EXPECT_EQ(car.plans(PathPolicy::kDuplicate, at_ms(0))[0].rate, whole);
  car.lanes[1].budget.scale(0.5, at_ms(0));
  EXPECT_NEAR(car.plans(PathPolicy::kDuplicate, at_ms(0))[0].rate, whole / 2, 1.0);
  const auto best = car.plans(PathPolicy::kBest, at_ms(0));
  ASSERT_EQ(best.size(), 2U);
  for (const PacketPlan& plan : best) {
    EXPECT_NEAR(plan.rate, plan.paths == bit_of(0) ? whole : whole / 2, 1.0);
  }
}

TEST(PathChoice, DuplicateIsOnePacketOnBoth) {
  const CarOfPaths car;
  const auto plans = car.plans(PathPolicy::kDuplicate, at_ms(0));
  ASSERT_EQ(plans.size(), 1U);
  EXPECT_EQ(plans[0].paths, bit_of(0) | bit_of(1));
}

TEST(PathChoice, BestHasSafetyOnBothAndTheRestOnTheBetter) {
  CarOfPaths car;
  car.lanes[0].loss = 0.3;
  car.lanes[1].loss = 0.1;
  auto plans = car.plans(PathPolicy::kBest, at_ms(0));
  ASSERT_EQ(plans.size(), 2U);
  EXPECT_EQ(plans[0].paths, bit_of(1));
  EXPECT_FALSE(plans[0].only_safety);
  EXPECT_EQ(plans[1].paths, bit_of(0));
  EXPECT_TRUE(plans[1].only_safety);
  // Silence tells sooner than loss.
  car.lanes[0].received_at = at_ms(1'000);
  car.lanes[1].received_at = at_ms(900);
  plans = car.plans(PathPolicy::kBest, at_ms(1'000));
  EXPECT_EQ(plans[0].paths, bit_of(0));
  // Between slots the better one alone.
  plans = car.plans(PathPolicy::kBest, at_ms(1'000), true);
  ASSERT_EQ(plans.size(), 1U);
  EXPECT_EQ(plans[0].paths, bit_of(0));
  EXPECT_TRUE(plans[0].between);
}

// As when nothing may be arriving: little room is enough, and no policy keeps it to one path.
TEST(PathChoice, AStopGoesOnEveryPath) {
  for (const PathPolicy policy : {PathPolicy::kDuplicate, PathPolicy::kBest}) {
    const CarOfPaths car;
    std::uint8_t paths = 0;
    for (const PacketPlan& plan : car.plans_at_once(policy, at_ms(0))) {
      EXPECT_TRUE(plan.between);
      paths |= plan.paths;
    }
    EXPECT_EQ(paths, bit_of(0) | bit_of(1));
  }
}

TEST(PathChoice, APathWithoutRoomHasNoPlan) {
  for (const PathPolicy policy : {PathPolicy::kDuplicate, PathPolicy::kBest}) {
    CarOfPaths car;
    car.exhaust(0, at_ms(0));
    auto plans = car.plans(policy, at_ms(1));
    ASSERT_EQ(plans.size(), 1U);
    EXPECT_EQ(plans[0].paths, bit_of(1));
    EXPECT_FALSE(plans[0].only_safety);
    car.exhaust(1, at_ms(1));
    EXPECT_TRUE(car.plans(policy, at_ms(2)).empty());
  }
}

TEST(PathChoice, MuchLessRoomIsAPacketOfItsOwn) {
  CarOfPaths car;
  const std::size_t much = car.lanes[1].budget.room_beside(60, at_ms(0));
  car.lanes[1].spend(much, 60, at_ms(0));
  const auto plans = car.plans(PathPolicy::kDuplicate, at_ms(6));
  ASSERT_EQ(plans.size(), 2U);
  EXPECT_EQ(plans[0].paths, bit_of(1));
  EXPECT_EQ(plans[1].paths, bit_of(0));
  EXPECT_LT(plans[0].safety_room, plans[1].safety_room);
}

// Room for itself and little more: worth its price only where what left may be lost.
TEST(PathChoice, BetweenSlotsAPacketMustCarryMoreThanItself) {
  CarOfPaths car(1);
  car.lanes[0].spend(car.lanes[0].budget.room_beside(60, at_ms(0)), 60, at_ms(0));
  const Instant now = at_ms(5);
  const std::size_t room = car.lanes[0].budget.room_for_safety(now);
  ASSERT_GT(room, 100U);
  ASSERT_LT(room, 230U);
  EXPECT_EQ(car.plans(PathPolicy::kDuplicate, now, true, false).size(), 0U);
  EXPECT_EQ(car.plans(PathPolicy::kDuplicate, now, true, true).size(), 1U);
  EXPECT_EQ(car.plans(PathPolicy::kDuplicate, at_ms(15), true, false).size(), 1U);
}

}  // namespace
}  // namespace pitwall::telemetry

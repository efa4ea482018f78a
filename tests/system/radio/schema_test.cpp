// Ends of two versions: what both know alike is read, the rest is skipped, and a car whose safety
// groups the base understands otherwise is not to be armed.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <string>

#include "protocol/telemetry/registry/schema_listing.hpp"
#include "tests/system/radio/radio_setups.hpp"

namespace pitwall::radio {
namespace {

using telemetry::Direction;
using telemetry::Group;
using telemetry::SchemaDescription;

constexpr std::size_t kMany = 40;  // more than any group

// A version of the registry: what is otherwise in it than in ours.
struct Version {
  SchemaDescription claim = telemetry::own_schema();
  std::string text = telemetry::safety_text();

  SchemaDescription::Place& place(Group group) {
    for (auto* places : {&claim.down, &claim.up}) {
      for (auto& place : *places) {
        if (place.group.own == group) return place;
      }
    }
    return claim.down[kMany];  // CHECKs
  }
  // Its definition differs in something that takes no bit: a name, a label, a range.
  Version& redefine(Group group) {
    place(group).hash ^= 0x5A5A5A5A;
    changed(group);
    return *this;
  }
  Version& remove(Group group) {
    SchemaDescription::Places& places =
        telemetry::row_of(group).direction == Direction::kDown ? claim.down : claim.up;
    SchemaDescription::Places rest;
    for (const auto& place : places) {
      if (place.group.own == group) continue;
      EXPECT_TRUE(rest.push(place));
    }
    places = rest;
    changed(group);
    return *this;
  }
  Version& reverse() {
    std::reverse(claim.down.begin(), claim.down.end());
    claim.whole_hash ^= 0x77;
    return *this;
  }
  const SchemaDescription* done() {
    claim.safety_text = text;
    return &claim;
  }

 private:
  void changed(Group group) {
    claim.whole_hash ^= 0x1234567 + static_cast<std::uint64_t>(group);
    if (telemetry::row_of(group).priority != telemetry::Class::kSafety) return;
    claim.safety_hash ^= 0x7654321 + static_cast<std::uint64_t>(group);
    const std::string name(telemetry::row_of(group).name);
    text.replace(text.find("group " + name), 6 + name.size(), "group " + name + "_of_then");
  }
};

struct Seen {
  telemetry::GroupSet groups;  // that the base has
  bool car_agrees = false, base_agrees = false, stop_received = false;
  std::string difference;
  std::uint64_t content_errors = 0, bad_bodies = 0;
};

Seen look(const SchemaDescription* car, const SchemaDescription* base) {
  RadioSetup setup = lossy(0.2, 11);
  setup.schema_of_car = car;
  setup.schema_of_base = base;
  VirtualRadio radio(setup);
  radio.station().stop().demand(telemetry::StopLevel::kControlled,
                                telemetry::StopReason::kOperator);
  for (int ms = 0; ms < 20'000; ++ms) {
    radio.step();
    while (radio.station().next_bulk()) {
    }
  }
  Seen seen;
  for (const auto& row : telemetry::kGroupTable) {
    if (radio.sample_at_base(row.group)) seen.groups.add(row.group);
  }
  seen.car_agrees = radio.car().schema_agrees();
  seen.base_agrees = radio.station().schema_agrees();
  seen.difference = radio.station().schema_difference();
  seen.stop_received = radio.car().view(radio.car_now()).stop == telemetry::StopLevel::kControlled;
  seen.content_errors = radio.content_errors().all();
  for (const std::uint64_t bad : radio.base_report().bad_bodies) seen.bad_bodies += bad;
  for (const std::uint64_t bad : radio.car_report().bad_bodies) seen.bad_bodies += bad;
  return seen;
}

telemetry::GroupSet all_but(std::initializer_list<Group> missing) {
  telemetry::GroupSet set = telemetry::groups_of(Direction::kDown);
  for (const Group group : missing) set.remove(group);
  return set;
}

// Both ways: the car is the one of the other version, or the base is.
void expect_both_ways(Version version, const telemetry::GroupSet& groups, bool agree) {
  const SchemaDescription* other = version.done();
  for (const bool at_car : {true, false}) {
    const Seen seen = look(at_car ? other : nullptr, at_car ? nullptr : other);
    EXPECT_EQ(seen.groups.bits, groups.bits) << at_car;
    EXPECT_EQ(seen.car_agrees, agree) << at_car;
    EXPECT_EQ(seen.base_agrees, agree) << at_car;
    EXPECT_EQ(seen.difference.empty(), agree) << seen.difference;
    EXPECT_EQ(seen.content_errors, 0u) << at_car;
    EXPECT_EQ(seen.bad_bodies, 0u) << at_car;
  }
}

TEST(Schema, TheSameVersionAgreesAndSaysNothingOfIt) {
  const Seen seen = look(nullptr, nullptr);
  EXPECT_EQ(seen.groups.bits, all_but({}).bits);
  EXPECT_TRUE(seen.car_agrees && seen.base_agrees && seen.stop_received);
  EXPECT_TRUE(seen.difference.empty());
}

TEST(Schema, AGroupThatMeansSomethingElseIsNotRead) {
  expect_both_ways(Version{}.redefine(Group::kTyres), all_but({Group::kTyres}), true);
  expect_both_ways(Version{}.redefine(Group::kEgo).redefine(Group::kBus),
                   all_but({Group::kEgo, Group::kBus}), true);
}

TEST(Schema, AGroupThatOneEndDoesNotHaveIsSkipped) {
  expect_both_ways(Version{}.remove(Group::kRadio), all_but({Group::kRadio}), true);
  expect_both_ways(Version{}.remove(Group::kTrack).remove(Group::kFuel),
                   all_but({Group::kTrack, Group::kFuel}), true);
}

TEST(Schema, AnotherOrderIsReadAllTheSame) {
  expect_both_ways(Version{}.reverse(), all_but({}), true);
  expect_both_ways(Version{}.remove(Group::kGnss0).reverse(), all_but({Group::kGnss0}), true);
}

TEST(Schema, ASafetyGroupThatDiffersForbidsArmingAndIsNamed) {
  expect_both_ways(Version{}.redefine(Group::kMode), all_but({Group::kMode}), false);
  Version version;
  const Seen seen = look(nullptr, version.redefine(Group::kMode).done());
  EXPECT_NE(seen.difference.find("mode"), std::string::npos) << seen.difference;
}

TEST(Schema, AStopThatTheCarDoesNotUnderstandForbidsArming) {
  Version version;
  version.redefine(Group::kStop);
  const Seen seen = look(nullptr, version.done());
  EXPECT_FALSE(seen.car_agrees);
  EXPECT_FALSE(seen.stop_received);
  // One that it does understand works beside another group that it does not.
  Version other;
  other.redefine(Group::kTyres);
  EXPECT_TRUE(look(other.done(), nullptr).stop_received);
}

}  // namespace
}  // namespace pitwall::radio

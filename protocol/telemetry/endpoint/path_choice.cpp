// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/endpoint/path_choice.hpp"

#include <algorithm>

namespace pitwall::telemetry {
namespace {

// Less body than this is no packet: fixed part, acknowledgement, two groups of safety.
constexpr std::size_t kLeastBody = kBodyFixed + kAckSize + 12;
// Between slots a packet is made only if it carries more than itself.
constexpr std::size_t kLeastBetween = 128;  // bears 3 ms of jitter at 256 kbit/s
// A path with so much less room than the best one gets packets of its own.
constexpr std::size_t kMuchLess = 2;
// A path that is silent for so long is not the better one.
constexpr Duration kSilent = milliseconds(60);
static_assert(kPaths == 2);

}  // namespace

FixedVector<PacketPlan, kPaths> PathChoice::plans(bool between, Instant now) const {
  std::uint8_t paths = 0;
  for (PathId path = 0; path < lanes.size(); ++path) {
    if (has_room(path, between, now)) paths |= bit_of(path);
  }
  const bool best = policy == PathPolicy::kBest;
  const std::uint8_t first = best && paths != 0 ? bit_of(better(paths)) : apart(paths, now);
  const auto second = static_cast<std::uint8_t>(paths & ~first);
  FixedVector<PacketPlan, kPaths> plans;
  if (first != 0) CHECK(plans.push(plan(first, {.between = between}, now)));
  if (second == 0 || (best && between && !at_once)) return plans;
  CHECK(plans.push(plan(second, {.only_safety = best, .between = between}, now)));
  return plans;
}

PacketPlan PathChoice::plan(std::uint8_t paths, Kind kind, Instant now) const {
  PacketPlan plan{.paths = paths,
                  .safety_room = kMaxBody,
                  .only_safety = kind.only_safety,
                  .between = kind.between};
  for (PathId path = 0; path < lanes.size(); ++path) {
    if (!has(paths, path)) continue;
    const double rate = lanes[path].budget.present_rate();
    plan.rate = plan.rate > 0.0 ? std::min(plan.rate, rate) : rate;
    const bool proved = association.addresses(path).proved().known();
    const std::size_t trial = kind.between && proved ? 0 : trial_room(path);
    if (trial > 0 && paths == bit_of(path)) {
      plan.trial = true;
      plan.most = trial - kAround;
    }
    const std::size_t room = lanes[path].budget.room_for_safety(now) - kAround;
    plan.safety_room = std::min({plan.safety_room, room, plan.most});
  }
  return plan;
}

// The largest datagram that may go to the address on trial; 0: none.
std::size_t PathChoice::trial_room(PathId path) const {
  constexpr std::size_t kLeast = kAround + kLeastBody + kTokenSize, kGrain = 32;
  if (!association.addresses(path).on_trial()) return 0;
  for (std::size_t size = kMaxDatagram; size >= kLeast; size -= kGrain) {
    const auto targets = association.addresses(path).targets(size);
    if (!targets.empty() && targets.back() != association.addresses(path).proved()) return size;
  }
  return 0;
}

bool PathChoice::has_room(PathId path, bool between, Instant now) const {
  const PathBudget& budget = lanes[path].budget;
  constexpr std::size_t kLeast = kAround + kLeastBody;
  const bool ample = budget.room_beside(kLeast, now) >= kLeast + kLeastBetween;
  const bool enough = !between || association.addresses(path).on_trial() || in_doubt || at_once;
  const bool room = ample || (enough && budget.room_for_safety(now) >= kLeast);
  return room && (association.addresses(path).proved().known() || trial_room(path) > 0);
}

// A path that must prove itself, or that has much less room than the other, has its own packet.
std::uint8_t PathChoice::apart(std::uint8_t paths, Instant now) const {
  if (paths != (bit_of(0) | bit_of(1))) return 0;
  if (lanes[0].proof || association.addresses(0).on_trial()) return bit_of(0);
  if (lanes[1].proof || association.addresses(1).on_trial()) return bit_of(1);
  const std::size_t room[] = {lanes[0].budget.room_beside(kAround + kLeastBody, now),
                              lanes[1].budget.room_beside(kAround + kLeastBody, now)};
  if (room[0] * kMuchLess < room[1]) return bit_of(0);
  if (room[1] * kMuchLess < room[0]) return bit_of(1);
  return 0;
}

PathId PathChoice::better(std::uint8_t paths) const {
  if (!has(paths, 1)) return 0;
  if (!has(paths, 0)) return 1;
  const Duration ahead = lanes[0].received_at - lanes[1].received_at;
  if (ahead > kSilent) return 0;
  if (-ahead > kSilent) return 1;
  return lanes[1].loss < lanes[0].loss ? 1 : 0;
}

}  // namespace pitwall::telemetry

// SPDX-License-Identifier: Apache-2.0
#include "tests/system/radio_explorer/explorer.hpp"

#include <array>
#include <unordered_set>

namespace pitwall::explorer {
namespace {

constexpr std::size_t kDepthMax = 39;

struct Way {
  std::array<Action, kDepthMax> actions{};
  std::uint8_t length = 0;

  Way then(Action action) const {
    Way longer = *this;
    longer.actions[longer.length++] = action;
    return longer;
  }
};

struct Seen {
  std::uint64_t a, b;
  bool operator==(const Seen&) const = default;
};
struct HashOfSeen {
  std::size_t operator()(const Seen& seen) const { return seen.a; }
};

World walk(World world, const Way& way) {
  for (std::size_t i = 0; i < way.length; ++i) world.act(way.actions[i]);
  return world;
}

}  // namespace

Explored explore(const Budget& budget, Planted planted, std::size_t depth, std::size_t worlds_max,
                 PlantedRoam roam) {
  CHECK(depth <= kDepthMax);
  const World start(budget, planted, roam);
  std::unordered_set<Seen, HashOfSeen> seen;
  std::vector<Way> frontier{Way{}}, next;
  Explored out;
  for (; out.depth < depth && !frontier.empty(); ++out.depth) {
    next.clear();
    for (const Way& way : frontier) {
      const World world = walk(start, way);
      for (std::size_t i = 0; i < kActions; ++i) {
        const auto action = static_cast<Action>(i);
        if (!world.can(action)) continue;
        World after = world;
        const Broken broken = after.act(action);
        ++out.transitions;
        if (broken != Broken::kNothing) {
          const Way there = way.then(action);
          out.worlds = seen.size();
          out.breach =
              Breach{broken, {there.actions.begin(), there.actions.begin() + there.length}};
          return out;
        }
        const auto print = after.fingerprint();
        if (seen.insert({print.a, print.b}).second) next.push_back(way.then(action));
      }
      if (seen.size() > worlds_max) {
        out.worlds = seen.size();
        return out;
      }
    }
    frontier.swap(next);
  }
  out.worlds = seen.size();
  out.exhausted = frontier.empty();
  return out;
}

std::string text_of(const Breach& breach) {
  std::string text = text_of(breach.what);
  for (const Action action : breach.way) text += std::string{"\n  "} + text_of(action);
  return text;
}

}  // namespace pitwall::explorer

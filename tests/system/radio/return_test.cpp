// Back to where the base may be found: both ends move, a relay forwards for a while and falls
// silent, a base dies after it moved and a spare one is where the car was told. A thousand seeds of
// each: the link is back within two seconds of an honest path.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>
#include <optional>
#include <random>

#include "tests/benchmarks/radio/relay.hpp"
#include "tests/system/radio/radio_setups.hpp"

namespace pitwall::radio {
namespace {

using telemetry::Group;
using telemetry::PathId;

constexpr int kSeeds = 1'000;
constexpr UdpAddress kSecondHome{0x0A000007, 5'700};

class Scene {
 public:
  explicit Scene(std::uint64_t seed)
      : random(seed), radio(setup(seed, random)), relay(radio, kWay, milliseconds(1)) {
    run(seconds(2));
  }

  void run(Duration length) {
    for (const Instant end = radio.now() + length; radio.now() < end;) {
      relay.step();
      radio.step();
    }
  }
  Duration some(int from_ms, int to_ms) {
    return milliseconds(from_ms +
                        static_cast<int>(random() % static_cast<unsigned>(to_ms - from_ms)));
  }
  // Until both ends have heard what the other said from now on.
  Duration time_to_link() {
    const Instant begin = radio.now();
    const Instant begin_of_car = radio.car_now();
    while (radio.now() - begin < seconds(10)) {
      run(kStep);
      const auto sample = radio.sample_at_base(Group::kMode);
      const auto alive = radio.car().view(radio.car_now()).alive_at;
      if (sample && *sample >= begin && alive && *alive >= begin_of_car) break;
    }
    return radio.now() - begin;
  }

  std::mt19937 random;
  VirtualRadio radio;
  Relay relay;

 private:
  // One path or two, clean or with a loss of up to a tenth.
  static RadioSetup setup(std::uint64_t seed, std::mt19937& random) {
    const auto paths = static_cast<std::uint8_t>(1 + random() % 2);
    RadioSetup setup = lossy(static_cast<double>(random() % 3) * 0.05, seed, paths);
    for (PathId path = 0; path < telemetry::kPaths; ++path) {
      setup.spare[path] = {kSecondHome.ip, static_cast<std::uint16_t>(kSecondHome.port + path)};
    }
    setup.stamps_kept = random() % 2 == 0;
    return setup;
  }
};

UdpAddress anywhere(std::mt19937& random) {
  return {0x0A020000U + static_cast<std::uint32_t>(random() % 60'000),
          static_cast<std::uint16_t>(12'000 + random() % 20'000)};
}

UdpAddress home(const Scene& scene, PathId path) {
  // Where a car looks for its base from the beginning.
  static const VirtualRadio kFresh(setup_of(clean_link(), 2));
  (void)scene;
  return kFresh.base_address(path);
}

PathId paths_of(Scene& scene) { return scene.radio.base_report().paths[1].peer.known() ? 2 : 1; }

void report(const char* what, Duration worst) {
  std::cout << what << ": back after " << worst.milliseconds() << " ms at most\n";
}

TEST(Return, FromARaceInWhichBothEndsMove) {
  Duration worst{};
  for (int seed = 1; seed <= kSeeds; ++seed) {
    Scene scene(static_cast<std::uint64_t>(seed));
    const PathId paths = paths_of(scene);
    for (int moves = 0; moves < 4; ++moves) {
      for (PathId path = 0; path < paths; ++path) {
        if (scene.random() % 2 == 0) scene.radio.move_car(path, anywhere(scene.random));
        if (scene.random() % 2 == 0) scene.radio.move_base(path, anywhere(scene.random));
      }
      scene.run(scene.some(1, 400));
    }
    for (PathId path = 0; path < paths; ++path) {
      const UdpAddress second{kSecondHome.ip, static_cast<std::uint16_t>(kSecondHome.port + path)};
      scene.radio.move_base(path, scene.random() % 2 == 0 ? home(scene, path) : second);
    }
    const Duration back = scene.time_to_link();
    ASSERT_LE(back, seconds(2)) << "seed " << seed;
    worst = std::max(worst, back);
  }
  report("both ends moved", worst);
}

TEST(Return, FromARelayThatFallsSilent) {
  Duration worst{};
  for (int seed = 1; seed <= kSeeds; ++seed) {
    Scene scene(static_cast<std::uint64_t>(seed));
    scene.relay.begin();
    scene.run(scene.some(200, 1'500));
    if (scene.random() % 2 == 0) {
      // The honest way fails for a while, so that both ends answer the relay alone.
      for (PathId path = 0; path < telemetry::kPaths; ++path) {
        scene.radio.move_car(path, anywhere(scene.random));
      }
      scene.run(scene.some(200, 1'500));
    }
    scene.relay.stop();
    const Duration back = scene.time_to_link();
    ASSERT_LE(back, seconds(2)) << "seed " << seed;
    worst = std::max(worst, back);
  }
  report("a relay fell silent", worst);
}

TEST(Return, ToASpareBaseAfterTheOneThatMovedDied) {
  Duration worst{};
  for (int seed = 1; seed <= kSeeds; ++seed) {
    Scene scene(static_cast<std::uint64_t>(seed));
    const PathId paths = paths_of(scene);
    for (PathId path = 0; path < paths; ++path) scene.radio.move_base(path, anywhere(scene.random));
    scene.run(scene.some(20, 2'000));
    const bool second = scene.random() % 2 == 0;
    for (PathId path = 0; path < paths; ++path) {
      const UdpAddress spare{kSecondHome.ip, static_cast<std::uint16_t>(kSecondHome.port + path)};
      scene.radio.move_base(path, second ? spare : home(scene, path));
    }
    const Duration away = scene.some(0, 3'000);
    scene.radio.restart_base(away);
    scene.run(away);
    const Duration back = scene.time_to_link();
    ASSERT_LE(back, seconds(2)) << "seed " << seed;
    worst = std::max(worst, back);
  }
  report("a spare base took over", worst);
}

}  // namespace
}  // namespace pitwall::radio

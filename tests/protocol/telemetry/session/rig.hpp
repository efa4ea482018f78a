// Car and base associations whose datagrams the test carries by itself.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "protocol/telemetry/session/association.hpp"

namespace pitwall::telemetry::testing {

using Datagram = std::vector<std::uint8_t>;

inline constexpr UdpAddress kCarAddress{.ip = 0x0A000001, .port = 5'001};
inline constexpr UdpAddress kBaseAddress{.ip = 0x0A000002, .port = 6'001};
inline constexpr UdpAddress kElsewhere{.ip = 0x0A000063, .port = 7'777};

struct KeyPair {
  KeyFile car, base;
};
inline KeyPair make_pair(std::uint64_t seed) {
  SeededRandomness randomness(seed);
  const Identity car = make_identity(randomness), base = make_identity(randomness);
  return {.car = {.role = Role::kCar, .own = car, .peer = base.public_key},
          .base = {.role = Role::kBase, .own = base, .peer = car.public_key}};
}

struct EndOptions {
  bool signed_only = false;
  std::uint8_t paths = 1;
  std::uint64_t first_sequence = 1;
  // nullopt: the seed in ms, so that of two cars the one with the higher seed is the later one.
  std::optional<Duration> to_utc{};
  Stamp newest_stamp = 0;
  std::array<FixedVector<UdpAddress, kSpares>, kPaths> spare{};
};

class End {
 public:
  End(const KeyFile& keys, std::uint64_t seed, const EndOptions& options = {})
      : randomness_(seed),
        association_({.keys = keys,
                      .greeting = {.boot = seed,
                                   .safety_schema = 1,
                                   .whole_schema = 2,
                                   .signed_only = options.signed_only},
                      .peer = keys.role == Role::kCar
                                  ? std::array<UdpAddress, kPaths>{kBaseAddress, kBaseAddress}
                                  : std::array<UdpAddress, kPaths>{},
                      .spare = options.spare,
                      .paths = options.paths,
                      .first_sequence = options.first_sequence,
                      .to_utc = options.to_utc.value_or(milliseconds(static_cast<int>(seed))),
                      .newest_stamp = options.newest_stamp},
                     randomness_) {}

  Association* operator->() { return &association_; }
  Association& operator*() { return association_; }

  std::optional<Opened> feed(const Datagram& datagram, UdpAddress from, Instant now,
                             PathId path = 0) {
    return association_.feed(datagram, path, from, now, plain_);
  }
  std::optional<std::pair<Datagram, UdpAddress>> poll(Instant now, PathId path = 0) {
    const std::size_t size = association_.poll_size(path, now);
    const auto due = association_.poll(path, now, out_);
    EXPECT_LE(due ? due->bytes.size() : 0, size);
    if (!due) return std::nullopt;
    return std::pair{Datagram(due->bytes.begin(), due->bytes.end()), due->to};
  }
  // A packet that holds one number; empty if there are no keys.
  Datagram seal(std::uint32_t content, Instant now) {
    std::array<std::uint8_t, 64> body{};
    for (std::size_t i = 0; i < 4; ++i) body[i] = static_cast<std::uint8_t>(content >> 8 * i);
    const auto sealed = association_.seal(body, now, out_);
    if (!sealed) return {};
    return {sealed->datagram.begin(), sealed->datagram.end()};
  }
  std::uint64_t refused(Refusal refusal) {
    return association_.counters().refused[static_cast<std::size_t>(refusal)];
  }

 private:
  SeededRandomness randomness_;
  Association association_;
  std::array<std::uint8_t, kMaxDatagram> plain_{}, out_{};
};

// Exchanges the opening and its answer: the car has keys, the base waits for the first packet.
inline void exchange(End& car, End& base, Instant now, UdpAddress car_at = kCarAddress) {
  const auto opening = car.poll(now);
  ASSERT_TRUE(opening);
  base.feed(opening->first, car_at, now);
  const auto answer = base.poll(now);
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->second, car_at);
  car.feed(answer->first, kBaseAddress, now);
}

// Establishes a session that works in both directions.
inline void establish(End& car, End& base, Instant now, UdpAddress car_at = kCarAddress) {
  exchange(car, base, now, car_at);
  ASSERT_TRUE(car->ready());
  ASSERT_TRUE(base.feed(car.seal(1, now), car_at, now));
  ASSERT_TRUE(car.feed(base.seal(1, now), kBaseAddress, now));
}

struct Rig {
  KeyPair keys = make_pair(1);
  std::unique_ptr<End> car, base;
  Instant now{seconds(100).ns};

  explicit Rig(const EndOptions& options = {})
      : car(std::make_unique<End>(keys.car, 11, options)),
        base(std::make_unique<End>(keys.base, 12, options)) {}
  void establish() { testing::establish(*car, *base, now); }
};

}  // namespace pitwall::telemetry::testing

// Attacks and key errors over the emulated radio: which end sees which, how soon, and that nothing
// of an honest network is taken for one.
// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/session/link_threats.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "tests/benchmarks/radio/forged_packets.hpp"
#include "tests/benchmarks/radio/virtual_radio.hpp"
#include "tests/system/radio/radio_setups.hpp"

namespace pitwall::radio {
namespace {

using telemetry::Threat;
using Bytes = std::vector<std::uint8_t>;

constexpr UdpAddress kStranger{0x0A0000FE, 6'666};
constexpr Duration kInTime = seconds(2);

bool each(Duration period, Instant now) { return now.ns % period.ns == 0; }

// When each end first saw each threat, while time passes.
class Onlooker {
 public:
  explicit Onlooker(VirtualRadio& radio) : radio_(radio) {}

  template <class Each>
  void run(Duration length, Each&& act) {
    for (const Instant end = radio_.now() + length; radio_.now() < end;) {
      act();
      radio_.step();
      if (!each(milliseconds(20), radio_.now())) continue;
      note(base_, radio_.base_report().threats);
      note(car_, radio_.car_report().threats);
      while (radio_.station().next_threat()) ++changes_at_base_;
      while (radio_.car().next_threat()) ++changes_at_car_;
    }
  }
  void run(Duration length) {
    run(length, [] {});
  }
  void begin() { began_ = radio_.now(), base_.clear(), car_.clear(); }
  // "refused at rate 0.2 s" of what was seen since begin(), in the order of Threat.
  std::string base() const { return text_of_all(base_); }
  std::string car() const { return text_of_all(car_); }
  // Seen in time, and nothing else.
  bool only_at_base(Threat threat) const { return only(base_, threat); }
  bool only_at_car(Threat threat) const { return only(car_, threat); }
  int changes_at_base() const { return changes_at_base_; }
  int changes_at_car() const { return changes_at_car_; }

 private:
  using Seen = std::map<Threat, Instant>;

  void note(Seen& seen, telemetry::ThreatSet active) const {
    for (std::size_t i = 0; i < telemetry::kThreats; ++i) {
      const auto threat = static_cast<Threat>(i);
      if (active.has(threat)) seen.emplace(threat, radio_.now());
    }
  }
  bool only(const Seen& seen, Threat threat) const {
    return seen.size() == 1 && seen.contains(threat) && seen.at(threat) - began_ <= kInTime;
  }
  std::string text_of_all(const Seen& seen) const {
    std::string text;
    for (const auto& [threat, at] : seen) {
      text += std::string{telemetry::text_of(threat)} + " after " +
              std::to_string((at - began_).milliseconds()) + " ms; ";
    }
    return text;
  }

  VirtualRadio& radio_;
  Instant began_{};
  Seen base_, car_;
  int changes_at_base_ = 0, changes_at_car_ = 0;
};

// The keys of a radio's ends, drawn as it draws them.
struct Pair {
  telemetry::KeyFile car, base;

  explicit Pair(std::uint64_t seed) {
    telemetry::SeededRandomness randomness(seed);
    base.role = telemetry::Role::kBase;
    car.own = telemetry::make_identity(randomness);
    base.own = telemetry::make_identity(randomness);
    car.peer = base.own.public_key;
    base.peer = car.own.public_key;
  }
};

telemetry::LinkEndpointConfig config_of(const telemetry::KeyFile& keys, bool signed_only = false) {
  telemetry::LinkEndpointConfig config;
  config.association.keys = keys;
  config.association.greeting.signed_only = signed_only;
  config.association.peer[0] = {0x0A000002, 5'000};
  // Beside the ends of the radio and after them.
  config.association.to_utc = seconds(10);
  return config;
}

// Another car at the same base; hears all that the base says.
class OtherCar {
 public:
  OtherCar(VirtualRadio& radio, const telemetry::LinkEndpointConfig& config)
      : radio_(radio), car_(config, randomness_) {
    radio.tap([this](bool down, telemetry::PathId, std::span<const std::uint8_t> bytes) {
      if (!down) received_.emplace_back(bytes.begin(), bytes.end());
      return true;
    });
  }
  void step() {
    for (const Bytes& bytes : received_) car_.feed(bytes, 0, {0x0A000002, 5'000}, radio_.car_now());
    received_.clear();
    if (!each(kTick, radio_.now())) return;
    while (const auto out = car_.poll(snapshot_, radio_.car_now()))
      radio_.inject(true, 0, kStranger, out->bytes);
    threats_.bits |= car_.report(radio_.car_now()).threats.bits;
  }
  telemetry::ThreatSet threats() const { return threats_; }

 private:
  VirtualRadio& radio_;
  telemetry::SeededRandomness randomness_{99};
  telemetry::CarEndpoint car_;
  telemetry::Snapshot snapshot_;
  std::vector<Bytes> received_;
  telemetry::ThreatSet threats_;
};

// Two unlike radios that lose, copy and reorder.
RadioSetup bad_network(std::uint64_t seed) {
  link::LinkParams fast = link::bursty(0.3, milliseconds(400), kRate, kWay), slow = fast;
  for (link::LinkParams* const link : {&fast, &slow}) {
    link->loss = 0.1;
    link->duplicate = 0.2;
    link->reorder = 0.1;
    link->reorder_by = milliseconds(80);
    link->jitter = milliseconds(10);
  }
  slow.delay = milliseconds(250);
  RadioSetup setup = setup_of(fast, 2);
  setup.down[1] = setup.up[1] = slow;
  setup.seed = seed;
  return setup;
}

TEST(LinkThreats, ABadNetworkIsNone) {
  for (const std::uint64_t seed : {1U, 2U, 3U, 4U}) {
    VirtualRadio radio(bad_network(seed));
    Onlooker onlooker(radio);
    onlooker.run(seconds(240));  // with two renewals of the keys
    EXPECT_EQ(onlooker.base(), "") << seed;
    EXPECT_EQ(onlooker.car(), "") << seed;
    EXPECT_GT(radio.base_report().association.renewals, 0U);
  }
}

TEST(LinkThreats, RestartsOfEitherEndAreNone) {
  for (const std::uint64_t seed : {1U, 2U, 3U, 4U, 5U, 6U}) {
    const bool clean = seed % 3 == 0;
    VirtualRadio radio(clean ? setup_of(clean_link(), 2) : bad_network(seed));
    Onlooker onlooker(radio);
    for (int i = 0; i < 12; ++i) {
      onlooker.run(milliseconds(3'000 + 1'370 * i));
      const Duration away = milliseconds(i % 3 == 0 ? 0 : 400 * i);
      if (i % 2 == 0) radio.restart_car(away);
      if (i % 2 == 1 || i % 5 == 0) radio.restart_base(away);
    }
    onlooker.run(seconds(30));
    EXPECT_EQ(onlooker.base(), "") << seed;
    EXPECT_EQ(onlooker.car(), "") << seed;
    EXPECT_TRUE(radio.base_report().established);
  }
}

TEST(LinkThreats, ChangesOfAddressAndPathsThatFallSilentAreNone) {
  for (const std::uint64_t seed : {1U, 2U, 3U, 4U, 5U, 6U}) {
    VirtualRadio radio(seed % 3 == 0 ? setup_of(clean_link(), 2) : bad_network(seed));
    Onlooker onlooker(radio);
    onlooker.run(seconds(15));
    for (std::uint16_t i = 0; i < 10; ++i) {
      const auto path = static_cast<telemetry::PathId>(i % 2);
      radio.move_car(path, {0x0A000001, static_cast<std::uint16_t>(4'100 + 2 * i + path)});
      onlooker.run(seconds(6));
      radio.cut(path, true, i % 4 < 2);  // down, or both ways
      onlooker.run(seconds(8));
      if (i % 3 == 0) radio.cut(1 - path, true, true);
      onlooker.run(seconds(4));
      radio.cut(0, false, false), radio.cut(1, false, false);
    }
    onlooker.run(seconds(30));
    EXPECT_EQ(onlooker.base(), "") << seed;
    EXPECT_EQ(onlooker.car(), "") << seed;
  }
}

TEST(LinkThreats, ProcessesThatStandStillAreNone) {
  VirtualRadio radio(bad_network(7));
  Onlooker onlooker(radio);
  for (const std::int64_t ms : {500, 2'000, 8'000, 30'000}) {
    onlooker.run(seconds(20));
    radio.pause(milliseconds(ms));
  }
  onlooker.run(seconds(20));
  EXPECT_EQ(onlooker.base(), "");
  EXPECT_EQ(onlooker.car(), "");
}

// There is no session, and none comes.
TEST(LinkThreats, ACarWithTheWrongKeyIsSeenByTheBase) {
  for (const bool beside_ours : {false, true}) {
    VirtualRadio radio(setup_of(clean_link()));
    if (!beside_ours) radio.restart_car(seconds(1'000));
    Onlooker onlooker(radio);
    onlooker.run(seconds(15));
    OtherCar other(radio, config_of(Pair(12'345).car));
    onlooker.begin();
    onlooker.run(seconds(5), [&] { other.step(); });
    EXPECT_TRUE(onlooker.only_at_base(Threat::kWrongKey)) << onlooker.base();
    EXPECT_EQ(onlooker.car(), "");
    EXPECT_EQ(radio.base_report().established, beside_ours);
  }
}

TEST(LinkThreats, SealedAgainstSignedIsSeenByBothEnds) {
  VirtualRadio radio(setup_of(clean_link()));
  radio.restart_car(seconds(1'000));
  Onlooker onlooker(radio);
  OtherCar other(radio, config_of(Pair(1).car, true));
  onlooker.begin();
  onlooker.run(kInTime, [&] { other.step(); });
  EXPECT_TRUE(onlooker.only_at_base(Threat::kModeMismatch)) << onlooker.base();
  EXPECT_TRUE(other.threats().has(Threat::kModeMismatch));
  onlooker.run(seconds(60), [&] { other.step(); });
  EXPECT_TRUE(onlooker.only_at_base(Threat::kModeMismatch)) << onlooker.base();
  EXPECT_EQ(onlooker.changes_at_base(), 1) << "the attempts grow longer";
}

// From a hundred a second to as many as a processor takes.
TEST(LinkThreats, ForgedDatagramsAreSeenByTheEndThatTheyReach) {
  for (const int each_10_ms : {1, 10, 500}) {
    VirtualRadio radio(setup_of(clean_link(), 2));
    Onlooker onlooker(radio);
    onlooker.run(seconds(15));
    Bytes packet;
    radio.tap([&](bool down, telemetry::PathId, std::span<const std::uint8_t> bytes) {
      if (down && bytes.size() > 30) packet.assign(bytes.begin(), bytes.end());
      return true;
    });
    onlooker.run(seconds(1));
    packet.back() ^= 1U;
    const Bytes forged = packet, noise(60, 0xFF);
    for (const bool at_base : {true, false}) {
      onlooker.begin();
      onlooker.run(seconds(12), [&] {
        if (!each(kTick, radio.now())) return;
        for (int i = 0; i < each_10_ms; ++i)
          radio.inject(at_base, 1, kStranger, at_base ? forged : noise);
      });
      EXPECT_TRUE(at_base ? onlooker.only_at_base(Threat::kRefusedAtRate)
                          : onlooker.only_at_car(Threat::kRefusedAtRate))
          << each_10_ms << " " << onlooker.base() << onlooker.car();
      EXPECT_EQ(at_base ? onlooker.car() : onlooker.base(), "");
      onlooker.run(seconds(30));
    }
    EXPECT_EQ(onlooker.changes_at_base(), 2) << "its begin and its end";
    EXPECT_EQ(onlooker.changes_at_car(), 2);
  }
}

TEST(LinkThreats, PacketsThatAreReflectedOrReplayedAtRateAreSeen) {
  VirtualRadio radio(setup_of(clean_link()));
  Onlooker onlooker(radio);
  onlooker.run(seconds(15));
  Bytes down, up;
  radio.tap([&](bool is_down, telemetry::PathId, std::span<const std::uint8_t> bytes) {
    (is_down ? down : up).assign(bytes.begin(), bytes.end());
    return true;
  });
  onlooker.run(seconds(30));
  const Bytes old = down;
  onlooker.begin();
  onlooker.run(seconds(5), [&] {
    if (each(kTick, radio.now())) radio.inject(false, 0, kStranger, down);
  });
  EXPECT_TRUE(onlooker.only_at_car(Threat::kRefusedAtRate)) << onlooker.car();
  EXPECT_EQ(onlooker.base(), "");
  onlooker.run(seconds(30));
  onlooker.begin();
  onlooker.run(seconds(5), [&] {
    if (each(kTick, radio.now())) radio.inject(true, 0, kStranger, old);
  });
  EXPECT_TRUE(onlooker.only_at_base(Threat::kRefusedAtRate)) << onlooker.base();
  EXPECT_EQ(onlooker.car(), "");
}

TEST(LinkThreats, ASecondCarWithOurKeysIsSeenByTheBase) {
  VirtualRadio radio(setup_of(clean_link()));
  Onlooker onlooker(radio);
  onlooker.run(seconds(15));
  OtherCar other(radio, config_of(Pair(1).car));
  onlooker.begin();
  onlooker.run(seconds(10), [&] { other.step(); });
  EXPECT_TRUE(onlooker.only_at_base(Threat::kSecondPeer)) << onlooker.base();
}

// It hears what our base hears, and answers a little later.
TEST(LinkThreats, ASecondBaseWithOurKeysIsSeenByTheCar) {
  VirtualRadio radio(setup_of(clean_link()));
  telemetry::SeededRandomness randomness(99);
  telemetry::StationEndpoint other(config_of(Pair(1).base), randomness);
  std::vector<Bytes> received;
  radio.tap([&](bool down, telemetry::PathId, std::span<const std::uint8_t> bytes) {
    if (down) received.emplace_back(bytes.begin(), bytes.end());
    return true;
  });
  Onlooker onlooker(radio);
  onlooker.begin();
  onlooker.run(seconds(10), [&] {
    if (!each(milliseconds(40), radio.now())) return;
    for (const Bytes& bytes : received) other.feed(bytes, 0, kStranger, radio.base_now());
    received.clear();
    while (const auto out = other.poll(radio.base_now()))
      radio.inject(false, 0, {0x0A000003, 5'000}, out->bytes);
  });
  EXPECT_TRUE(onlooker.only_at_car(Threat::kSecondPeer)) << onlooker.car();
  EXPECT_EQ(onlooker.base(), "");
}

// Openings of earlier starts of the car, before and after restarts of the base.
TEST(LinkThreats, ReplayedOpeningsAreSeenByTheBase) {
  for (const std::size_t distinct : {1U, 64U, 1'000U}) {
    VirtualRadio radio(setup_of(clean_link()));
    std::vector<Bytes> openings;
    radio.tap([&](bool down, telemetry::PathId, std::span<const std::uint8_t> bytes) {
      const auto header = telemetry::parse_header(bytes);
      const bool opening = down && header && header->kind == telemetry::Kind::kOpening;
      if (opening && openings.size() < distinct) openings.emplace_back(bytes.begin(), bytes.end());
      return true;
    });
    radio.cut(0, false, true);  // unanswered
    while (openings.size() < distinct) {
      radio.run(seconds(2));
      radio.restart_car();
    }
    radio.cut(0, false, false);
    Onlooker onlooker(radio);
    onlooker.run(seconds(30));
    for (const int per_s : {100, 1'000, 10'000}) {
      for (const bool restart : {false, true}) {
        onlooker.run(seconds(30));
        if (restart) radio.restart_base();
        onlooker.begin();
        std::size_t sent = 0;
        const Instant begin = radio.now();
        onlooker.run(seconds(5), [&] {
          const auto wanted = static_cast<std::size_t>((radio.now() - begin).seconds() * per_s) + 1;
          for (; sent < wanted; ++sent) {
            const UdpAddress from{0x0A000100 + static_cast<std::uint32_t>(sent % 200), 6'666};
            radio.inject(true, 0, from, openings[sent % openings.size()]);
          }
        });
        EXPECT_TRUE(onlooker.only_at_base(Threat::kReplayedOpenings))
            << distinct << " at " << per_s << "/s, restart " << restart << ": " << onlooker.base();
        EXPECT_EQ(onlooker.car(), "");
      }
    }
  }
}

// Some milliseconds faster than the packets themselves.
TEST(LinkThreats, ARelayIsSeenByTheEndThatItReaches) {
  for (const bool at_base : {true, false}) {
    link::LinkParams link;
    link.delay = milliseconds(5);
    VirtualRadio radio(setup_of(link, 2));
    Onlooker onlooker(radio);
    onlooker.run(seconds(15));
    radio.tap([&](bool down, telemetry::PathId path, std::span<const std::uint8_t> bytes) {
      if (down == at_base && path == 0) radio.inject(at_base, 0, kStranger, bytes);
      return true;
    });
    onlooker.begin();
    onlooker.run(seconds(5));
    EXPECT_TRUE(at_base ? onlooker.only_at_base(Threat::kRelay)
                        : onlooker.only_at_car(Threat::kRelay))
        << onlooker.base() << onlooker.car();
  }
}

}  // namespace
}  // namespace pitwall::radio

// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/radio/forged_packets.hpp"

#include <algorithm>
#include <numeric>

namespace pitwall::radio {

using namespace telemetry;  // NOLINT: the bench of this one module

namespace {

// Datagrams under way: those of the last half second. Replays are of before.
constexpr std::size_t kFresh = 64, kReceived = 512;
constexpr UdpAddress kForgerAddress{0x0A0000FE, 6'666};
constexpr std::uint8_t kPhaseBit = 0x02;
constexpr Duration kRestartEvery = seconds(7);

}  // namespace

const char* text_of(Forgery forgery) {
  constexpr std::array kTexts{"a bit turned",   "truncated",   "extended",    "spliced",
                              "replayed",       "reflected",   "other phase", "old session",
                              "of another car", "random bytes"};
  static_assert(kTexts.size() == kForgeries);
  return kTexts[static_cast<std::size_t>(forgery)];
}

std::uint64_t ForgeryFigures::total() const {
  return std::accumulate(sent.begin(), sent.end(), std::uint64_t{0});
}

PacketForger::PacketForger(VirtualRadio& radio, std::uint64_t seed) : radio_(radio), random_{seed} {
  radio.tap([this](bool down, PathId, std::span<const std::uint8_t> bytes) {
    auto& fresh = fresh_[down ? 1 : 0];
    auto& received = received_[down ? 1 : 0];
    fresh.emplace_back(bytes.begin(), bytes.end());
    if (fresh.size() <= kFresh) return true;
    received.push_back(std::move(fresh.front()));
    fresh.pop_front();
    if (received.size() > kReceived) received.pop_front();
    return true;
  });
  RadioSetup setup;
  setup.seed = seed + 99;
  VirtualRadio other(setup);
  other.tap([this](bool, PathId, std::span<const std::uint8_t> bytes) {
    foreign_.emplace_back(bytes.begin(), bytes.end());
    return true;
  });
  other.run(seconds(2));
}

std::uint64_t PacketForger::draw() { return random_.next(); }

const PacketForger::Bytes& PacketForger::received(bool down) {
  const auto& received = received_[down ? 1 : 0];
  static const Bytes kNothing{0};
  return received.empty() ? kNothing : received[draw() % received.size()];
}

PacketForger::Bytes PacketForger::forge(Forgery kind, bool at_base) {
  Bytes bytes = received(at_base);
  switch (kind) {
    case Forgery::kBitFlip:
      bytes[draw() % bytes.size()] ^= static_cast<std::uint8_t>(1U << draw() % 8);
      return bytes;
    case Forgery::kTruncated:
      bytes.resize(draw() % bytes.size());
      return bytes;
    case Forgery::kExtended:
      bytes.resize(bytes.size() + 1 + draw() % 64, static_cast<std::uint8_t>(draw()));
      return bytes;
    case Forgery::kSpliced: {
      const Bytes& tail = received(at_base);
      const std::size_t cut = 1 + draw() % bytes.size();
      if (cut >= tail.size() || std::equal(bytes.begin(), bytes.begin() + 7, tail.begin())) break;
      bytes.resize(std::min(cut, bytes.size()));
      bytes.insert(bytes.end(), tail.begin() + static_cast<std::ptrdiff_t>(cut), tail.end());
      return bytes;
    }
    case Forgery::kReplayed:
      return bytes;
    case Forgery::kReflected:
      return received(!at_base);
    case Forgery::kOldPhase:
      bytes[0] ^= kPhaseBit;
      return bytes;
    case Forgery::kOldSession:
      if (before_[at_base ? 1 : 0].empty()) return bytes;
      return before_[at_base ? 1 : 0][draw() % before_[at_base ? 1 : 0].size()];
    case Forgery::kOtherCar:
      return foreign_[draw() % foreign_.size()];
    case Forgery::kRandom:
      break;
  }
  bytes.assign(draw() % 1'500, 0);
  for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(draw());
  return bytes;
}

// What was heard of a session before is kept for later.
void PacketForger::note_sessions() {
  const std::uint64_t sessions = radio_.base_report().sessions + radio_.car_report().sessions;
  if (sessions == last_sessions_) return;
  last_sessions_ = sessions;
  before_ = received_;
}

void PacketForger::send(std::size_t count) {
  note_sessions();
  const std::uint64_t car = radio_.car_report().association.opened;
  const std::uint64_t base = radio_.base_report().association.opened;
  for (std::size_t i = 0; i < count; ++i) {
    const auto kind = static_cast<Forgery>(turn_++ % kForgeries);
    const bool at_base = draw() % 2 == 0;
    const Bytes bytes = forge(kind, at_base);
    ++figures_.sent[static_cast<std::size_t>(kind)];
    radio_.inject(at_base, 0, kForgerAddress, bytes);
  }
  figures_.accepted += radio_.car_report().association.opened - car;
  figures_.accepted += radio_.base_report().association.opened - base;
}

void PacketForger::flood(std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    const bool at_base = i % 2 == 0;
    Bytes bytes =
        fresh_[at_base ? 1 : 0].empty() ? received(at_base) : fresh_[at_base ? 1 : 0].back();
    bytes[bytes.size() - 1 - i % 16] ^= static_cast<std::uint8_t>(1U + i % 255);
    ++figures_.sent[static_cast<std::size_t>(Forgery::kBitFlip)];
    radio_.inject(at_base, 0, kForgerAddress, bytes);
  }
}

ForgeryFigures run_forgeries(VirtualRadio& radio, std::uint64_t count, std::size_t each_ms) {
  PacketForger forger(radio, 7);
  radio.run(seconds(3));
  Instant restart = radio.now() + kRestartEvery;
  bool car = false;
  while (forger.figures().total() < count) {
    radio.step();
    forger.send(each_ms);
    if (radio.now() < restart) continue;
    restart = restart + kRestartEvery;
    car ? radio.restart_car() : radio.restart_base();
    car = !car;
  }
  radio.tap({});
  return forger.figures();
}

}  // namespace pitwall::radio

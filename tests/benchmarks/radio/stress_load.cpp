// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/radio/stress_load.hpp"

#include "protocol/telemetry/packet/header.hpp"

namespace pitwall::radio {

using telemetry::Command;
using telemetry::CommandType;
using telemetry::Kind;

namespace {

constexpr telemetry::HolderId kWho = 1;
constexpr std::uint64_t kRenew_ms = 500;
constexpr int kCommandsEachStep = 3;
constexpr std::size_t kReceived = 64, kOpeningsEachStep = 8;
constexpr std::uint64_t kAddresses = 200;
constexpr std::uint64_t kFreshMessages_ms = 4'000, kBaseLives_ms = 700, kCarLives_ms = 1'100;

// The last millisecond of each so many.
bool ends(std::uint64_t ms, std::uint64_t every) { return ms % every == every - 1; }

}  // namespace

const char* text_of(Trouble trouble) {
  static constexpr const char* kTexts[] = {"", "commands", "openings", "restarts"};
  return kTexts[static_cast<std::size_t>(trouble)];
}

StressLoad::StressLoad(VirtualRadio& radio, Trouble trouble) : radio_(radio), trouble_(trouble) {
  if (trouble != Trouble::kOpenings) return;
  radio.tap([this](bool, telemetry::PathId, std::span<const std::uint8_t> bytes) {
    const auto header = telemetry::parse_header(bytes);
    const bool exchange = header && header->kind != Kind::kSealed && header->kind != Kind::kSigned;
    if (exchange && received_.size() < kReceived)
      received_.emplace_back(bytes.begin(), bytes.end());
    return true;
  });
}

void StressLoad::step() {
  if (trouble_ == Trouble::kCommands) command();
  if (trouble_ == Trouble::kOpenings) send_opening();
  if (trouble_ == Trouble::kRestarts) restart();
  ++ms_;
}

void StressLoad::command() {
  if (ms_ % kRenew_ms == 0 && !radio_.station().authority().renew(kWho, radio_.base_now())) {
    radio_.station().authority().take(kWho, radio_.base_now());
  }
  for (int i = 0; i < kCommandsEachStep; ++i) {
    const double speed_mps = 10.0 + static_cast<double>(ms_ % 100);
    (void)radio_.station().issue({CommandType::kSpeedLimit, speed_mps, kWho}, radio_.base_now());
  }
  while (const auto due = radio_.car().next_command(radio_.car_now())) {
    radio_.car().decide(due->id, telemetry::Outcome::kApplied, radio_.car_now());
    ++applied_;
  }
}

// Whole messages that were received before, and corrupted ones, from many addresses, at both ends.
void StressLoad::send_opening() {
  for (std::size_t i = 0; i < kOpeningsEachStep && !received_.empty(); ++i) {
    std::vector<std::uint8_t> bytes = received_[(ms_ + i) % received_.size()];
    if (i % 2 == 1) bytes[(ms_ + i) % bytes.size()] ^= 0x55;
    const UdpAddress from{0x0A000100 + static_cast<std::uint32_t>(ms_ % kAddresses),
                          static_cast<std::uint16_t>(1'000 + i)};
    radio_.inject(i % 4 < 2, 0, from, bytes);
    ++openings_;
  }
  if (ends(ms_, kFreshMessages_ms)) radio_.restart_base();
}

void StressLoad::restart() {
  if (ends(ms_, kBaseLives_ms)) radio_.restart_base();
  if (ends(ms_, kCarLives_ms)) radio_.restart_car();
}

}  // namespace pitwall::radio

// SPDX-License-Identifier: Apache-2.0
#include "tests/system/radio_explorer/world.hpp"

namespace pitwall::telemetry {

void Fingerprint::add(std::uint64_t word) {
  const auto mixed = [](std::uint64_t x) {  // splitmix64
    x = (x ^ x >> 30U) * 0xBF58476D1CE4E5B9ULL;
    x = (x ^ x >> 27U) * 0x94D049BB133111EBULL;
    return x ^ x >> 31U;
  };
  a = mixed(a + word);
  b = mixed(b ^ (word + 0x9E3779B97F4A7C15ULL));
}

void Fingerprint::add(const std::optional<Instant>& at) {
  add(at ? 1U : 0U);
  add(at.value_or(Instant{}));
}

// Times of the stages are for the display alone.
void Fingerprint::add(const CommandTransmitterOf<4>& transmitter) {
  add(std::uint64_t{transmitter.run_} << 32U | transmitter.car_boot_.value_or(0));
  add(transmitter.newest_);
  for (const auto& entry : transmitter.kept_) {
    add(entry.progress.id);
    add(entry.progress.issued);
    add(std::uint64_t{entry.car_boot} << 16U | std::uint64_t{entry.progress.command.issuer} << 8U |
        static_cast<std::uint64_t>(entry.progress.command.type));
    add(static_cast<std::uint64_t>(entry.progress.command.argument * 10.0));
    add(entry.progress.outcome ? 1U + static_cast<std::uint64_t>(*entry.progress.outcome) : 0U);
  }
  add(transmitter.acks_due_.size());
  for (const CommandId id : transmitter.acks_due_) add(id);
}

// Counters change nothing; of a handle only matters whether there is one.
void Fingerprint::add(const CommandLedgerOf<4>& ledger) {
  add(std::uint64_t{ledger.boot_} << 32U | ledger.run_.value_or(0));
  for (const auto& entry : ledger.entries_) {
    add(entry.number);
    add(static_cast<std::uint64_t>(entry.command.type) << 32U |
        std::uint64_t{entry.command.issuer} << 24U |
        static_cast<std::uint64_t>(entry.outcome) << 16U | (entry.handle != 0 ? 2U : 0U) |
        (entry.result_known ? 1U : 0U));
    add(static_cast<std::uint64_t>(entry.command.argument * 10.0));
    add(entry.expires);
  }
  for (const CommandId id : ledger.newest_out_) add(id);
  add(ledger.newest_);
}

void Fingerprint::add(const PathAddresses& addresses) {
  add(std::uint64_t{addresses.proved_.ip} << 16U | addresses.proved_.port);
  add(addresses.trial_ ? 1U : 0U);
  if (!addresses.trial_) return;
  const auto& trial = *addresses.trial_;
  add(std::uint64_t{trial.address.ip} << 16U | trial.address.port);
  add(trial.token);
  add(trial.first);
  add(trial.opposed);
}

void Fingerprint::add(const AuthorityRegister& transmitter) {
  add(std::uint64_t{transmitter.holder_} << 32U | std::uint64_t{transmitter.epoch_} << 16U |
      transmitter.renewal_);
  add(transmitter.renewed_);
}

void Fingerprint::add(const AuthorityView& view) {
  add(std::uint64_t{view.holder_} << 32U | std::uint64_t{view.epoch_} << 16U | view.renewal_);
  add(view.received_at_);
  add(view.renewed_);
}

void Fingerprint::add(const StopTransmitter& transmitter) {
  add(static_cast<std::uint64_t>(transmitter.state_.level) << 8U | transmitter.state_.epoch);
  add(transmitter.asked_ ? 1U + std::uint64_t{*transmitter.asked_} : 0U);
}

void Fingerprint::add(const StopLatch& latch) {
  add(static_cast<std::uint64_t>(latch.level_) << 16U |
      (latch.epoch_ ? 1U + std::uint64_t{*latch.epoch_} : 0U));
  add(std::uint64_t{latch.challenge_} << 16U | latch.next_challenge_);
}

}  // namespace pitwall::telemetry

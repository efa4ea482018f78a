// Random number source for keys, tokens and challenges: the operating system in the programs
// (SystemRandomness), a seeded stream in tests and in the bench.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>

namespace pitwall::telemetry {

class Randomness {
 public:
  virtual ~Randomness() = default;
  virtual void fill(std::span<std::uint8_t> bytes) = 0;
};

class SystemRandomness final : public Randomness {
 public:
  void fill(std::span<std::uint8_t> bytes) override;
};

// Repeatable, for tests and the bench only: its keys are not secret.
class SeededRandomness final : public Randomness {
 public:
  explicit SeededRandomness(std::uint64_t seed) : seed_(seed) {}
  void fill(std::span<std::uint8_t> bytes) override;

 private:
  std::uint64_t seed_, block_ = 0;
};

}  // namespace pitwall::telemetry

// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/cost/reference_kernel.hpp"

#include <cmath>
#include <numeric>
#include <utility>

namespace pitwall::cost {
namespace {

// Chosen by what neighbours do to `bench lockstep` and to a unit beside it: their ratio stays
// within 7 % while two programs turn over the caches, and while two compilers run.
constexpr int kTyreSteps = 100, kWheels = 4;
constexpr int kPredictions = 4;
constexpr int kReads = 100;
constexpr int kBytes = 1'500;

constexpr std::uint64_t scrambled(std::uint64_t x) {
  return x * 6364136223846793005ULL + 1442695040888963407ULL;
}

}  // namespace

ReferenceKernel::ReferenceKernel() : table_(kTable) {
  // One round through all of it: Sattolo, Information Processing Letters 22 (1986).
  std::iota(table_.begin(), table_.end(), std::uint64_t{0});
  std::uint64_t x = 1;
  for (std::uint64_t i = kTable - 1; i > 0; --i) {
    x = scrambled(x);
    std::swap(table_[i], table_[(x >> 32) % i]);
  }
  for (std::size_t i = 0; i < kStates; ++i) {
    start_[i * kStates + i] = 1.0;
    for (std::size_t k = 0; k < kStates; ++k)
      transition_[i * kStates + k] =
          i == k ? 0.99 : 1e-3 * static_cast<double>((7 * i + 3 * k) % 11);
  }
}

double ReferenceKernel::run() { return tyres() + matrices() + walk() + bits(); }

// Forces of four wheels by a magic formula, each step from the speeds that the last one left.
double ReferenceKernel::tyres() const {
  double lateral_mps = 1.0, yaw_radps = 0.1;
  for (int step = 0; step < kTyreSteps; ++step) {
    double force = 0.0, torque = 0.0;
    for (int wheel = 0; wheel < kWheels; ++wheel) {
      const double arm_m = wheel < 2 ? 1.7 : -1.3;
      const double slip = std::atan2(lateral_mps + arm_m * yaw_radps, 50.0 + wheel);
      const double load = std::sqrt(1.0 + slip * slip);
      const double f = -std::sin(1.4 * std::atan(12.0 * slip)) / load;
      force += f, torque += arm_m * f;
    }
    lateral_mps += 0.02 * force - 1e-3 * yaw_radps + 0.01;
    yaw_radps += 0.01 * torque;
  }
  return lateral_mps + yaw_radps;
}

// Covariances ahead in time, P = F P F'.
double ReferenceKernel::matrices() {
  const auto multiply = [](const Matrix& a, const Matrix& b, Matrix& out, bool transposed) {
    for (std::size_t i = 0; i < kStates; ++i)
      for (std::size_t k = 0; k < kStates; ++k) {
        double sum = 0.0;
        for (std::size_t j = 0; j < kStates; ++j)
          sum += a[i * kStates + j] * (transposed ? b[k * kStates + j] : b[j * kStates + k]);
        out[i * kStates + k] = sum;
      }
  };
  covariance_ = start_;
  for (int i = 0; i < kPredictions; ++i) {
    multiply(transition_, covariance_, product_, false);
    multiply(product_, transition_, covariance_, true);
  }
  return covariance_[kStates + 1];
}

// Each entry says where the next one is, all of them in one round: no read can begin before the
// last one has ended, and no unit reads what the last one did.
double ReferenceKernel::walk() {
  for (int i = 0; i < kReads; ++i) at_ = table_[at_];
  return static_cast<double>(at_ % 2);
}

// A checksum bit by bit, which no predictor of branches knows.
double ReferenceKernel::bits() const {
  unsigned crc = 0xFF;
  for (int i = 0; i < kBytes; ++i) {
    crc ^= static_cast<unsigned>(table_[static_cast<std::size_t>(i)]) & 0xFFU;
    for (int bit = 0; bit < 8; ++bit)
      if ((crc & 0x80U) != 0)
        crc = ((crc << 1) ^ 0x1DU) & 0xFFU;
      else
        crc = (crc << 1) & 0xFFU;
  }
  return static_cast<double>(crc);
}

}  // namespace pitwall::cost

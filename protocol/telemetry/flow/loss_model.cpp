// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/flow/loss_model.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace pitwall::telemetry {

namespace {

constexpr std::uint64_t kLeastLost = 20;
constexpr double kLossSigmas = 5.0;  // of the covariance that chance alone would show

}  // namespace

void LossModel::note(bool lost) {
  ++packets_;
  if (lost) {
    ++lost_;
    for (unsigned k = 1; k <= kLag; ++k) both_lost_[k] += last_ >> (k - 1) & 1U;
  }
  last_ = last_ << 1 | (lost ? 1U : 0U);
}

void LossModel::note_lost(std::uint64_t count) {
  const std::uint64_t single = std::min<std::uint64_t>(count, kLag);
  for (std::uint64_t i = 0; i < single; ++i) note(true);
  const std::uint64_t rest = count - single;  // all whose neighbours were lost, too
  packets_ += rest;
  lost_ += rest;
  for (unsigned k = 1; k <= kLag; ++k) both_lost_[k] += rest;
}

double LossModel::covariance(unsigned lag) const {
  const auto n = static_cast<double>(packets_);
  const double share = static_cast<double>(lost_) / n;
  return static_cast<double>(both_lost_[lag]) / (n - lag) - share * share;
}

std::optional<LossModel::Fit> LossModel::fit(Duration between_packets) const {
  if (lost_ < kLeastLost || packets_ == lost_) return std::nullopt;
  const auto n = static_cast<double>(packets_);
  const double came = 1.0 - static_cast<double>(lost_) / n;
  const double near = covariance(1), far = covariance(kLag);
  if (near <= kLossSigmas * came * (1.0 - came) / std::sqrt(n) || far >= near) return std::nullopt;
  // Bursts that end before kLag packets have passed leave nothing there but chance.
  const double least = near * 1e-3;
  const double decay = std::pow(std::max(far, least) / near, 1.0 / (kLag - 1));
  const double ratio = near / decay / (came * came);  // bad / good
  const Duration step = between_packets;
  const double memory = -1.0 / std::log(decay);  // packets
  const double bad = memory * (1.0 + ratio);
  return Fit{from_seconds(bad / ratio * step.seconds()), from_seconds(bad * step.seconds())};
}

}  // namespace pitwall::telemetry

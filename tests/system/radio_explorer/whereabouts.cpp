// SPDX-License-Identifier: Apache-2.0
#include "tests/system/radio_explorer/whereabouts.hpp"

#include <algorithm>

#include "tests/system/radio_explorer/world.hpp"

namespace pitwall::explorer {

using telemetry::PathAddresses;

namespace {

std::size_t index_of(UdpAddress address) { return address == kHome ? 0 : address == kAway ? 1 : 2; }

}  // namespace

BaseAddressModel::BaseAddressModel(PlantedRoam planted) : planted_(planted) {
  base_seen_.prove(kHome);
}

UpRoute BaseAddressModel::base_sends() {
  const UpRoute route{.from = base_at_, .number = ++sent_, .proof = owed_};
  owed_.reset();
  return route;
}

DownRoute BaseAddressModel::car_sends(bool to_trial) const {
  if (!to_trial) return {.to = base_seen_.proved(), .probe = {}};
  return {.to = base_seen_.targets(1).back(), .probe = base_seen_.token()};
}

bool BaseAddressModel::car_receives(const UpRoute& route, UdpAddress from, Instant now) {
  received_ = true;
  searched_ = false;
  const bool newest = route.number > newest_;
  newest_ = std::max(newest_, route.number);
  const auto token = base_seen_.token();
  const UdpAddress proved = base_seen_.proved();
  base_seen_.receive({.from = from, .size = 1'000, .number = route.number, .newest = newest}, now,
                     randomness_);
  if (base_seen_.token() && base_seen_.token() != token) {
    ++trials_;
    trial_first_ = route.number;
  }
  if (planted_ == PlantedRoam::kNewestProvesAddress && newest) base_seen_.prove(from);
  if (route.proof) (void)base_seen_.take_proof(from, *route.proof, now);
  if (from == proved && from != kRelay) {
    newest_of_base_ = std::max(newest_of_base_, route.number);
    base_received_ = now;
  }
  const bool base_lives = base_received_ && now - *base_received_ < PathAddresses::kInUse &&
                          newest_of_base_ >= trial_first_;
  const UdpAddress now_proved = base_seen_.proved();
  if (now_proved == proved) return true;
  return reached_[index_of(now_proved)] && !(now_proved == kRelay && base_lives);
}

bool BaseAddressModel::base_receives(const DownRoute& route) {
  if (route.to != kRelay && route.to != base_at_) return false;  // the relay forwards it
  if (route.probe) owed_ = route.probe, reached_[index_of(route.to)] = true;
  return true;
}

void BaseAddressModel::base_restarts() {
  base_at_ = kHome;  // a spare one, where the car was told
  owed_.reset();
  sent_ = newest_ = newest_of_base_ = 0;
  searched_ = false;
}

void BaseAddressModel::car_restarts() {
  base_seen_ = {};
  base_seen_.prove(kHome);
  owed_.reset();
  newest_ = newest_of_base_ = 0;
  reached_ = {true, false, false};
  base_received_.reset();
  received_ = true;
  searched_ = false;
}

void BaseAddressModel::base_moves() {
  base_at_ = base_at_ == kHome ? kAway : kHome;
  searched_ = false;
}

bool BaseAddressModel::wait() {
  searched_ = !received_;
  received_ = false;
  if (!searched_) return false;
  const bool home = base_at_ == kHome && planted_ != PlantedRoam::kNoReturn;
  if (!home && base_seen_.proved() != base_at_) return false;
  if (base_seen_.proved() != base_at_) base_seen_.prove(base_at_);
  return true;
}

bool BaseAddressModel::found() const {
  return !searched_ || base_at_ != kHome || base_seen_.proved() == kHome;
}

void BaseAddressModel::fingerprint(telemetry::Fingerprint& print) const {
  print.add(std::uint64_t{base_at_.port} << 32U | std::uint64_t{trials_} << 24U |
            std::uint64_t{sent_} << 16U | std::uint64_t{newest_} << 8U | newest_of_base_);
  print.add(std::uint64_t{trial_first_} << 8U | (reached_[1] ? 2U : 0U) | (reached_[2] ? 1U : 0U));
  print.add(owed_.value_or(0));
  print.add(base_received_);
  print.add((received_ ? 2U : 0U) | (searched_ ? 1U : 0U));
  print.add(base_seen_);
}

}  // namespace pitwall::explorer

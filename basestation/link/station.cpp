// SPDX-License-Identifier: Apache-2.0
#include "basestation/link/station.hpp"

#include <algorithm>
#include <cmath>

#include "protocol/telemetry/delivery/event_content.hpp"

namespace pitwall::link {

namespace {

template <class Item>
void push_bounded(std::deque<Item>& log, const Item& item) {
  log.push_back(item);
  if (log.size() > Station::kLogged) log.pop_front();
}

}  // namespace

bool Station::take(std::span<const std::uint8_t> datagram, telemetry::PathId path, UdpAddress from,
                   Instant received) {
  if (observer_) observer_(true, path, from, received, datagram);
  const auto arrival = endpoint_.feed(datagram, path, from, received);
  if (!arrival) return false;
  arrival_ = arrival;
  rate_.note(received);
  count(*arrival);
  const telemetry::Snapshot& state = endpoint_.state();
  ages_.show(state, received);
  const double station_m = state.values[telemetry::field("track.station")];
  if (!std::isnan(station_m)) {
    endpoint_.place(station_m, kSection_m * static_cast<double>(telemetry::kTrackBins), received);
  }
  collect();
  return true;
}

std::optional<telemetry::Outgoing> Station::poll(Instant now) {
  const auto out = endpoint_.poll(now);
  if (out && observer_) observer_(false, out->path, out->to, now, out->bytes);
  while (const auto change = endpoint_.next_threat()) note(*change);
  return out;
}

// The base's own event, among those of the car.
void Station::note(const telemetry::ThreatChange& change) {
  const telemetry::ThreatEvent content{.threat = static_cast<std::uint8_t>(change.threat),
                                       .begins = change.begins,
                                       .seen_by_base = true,
                                       .most_per_s = change.most_per_s};
  push_bounded(events_, telemetry::make_event(content, change.at));
  ++events_received_;
}

void Station::count(const telemetry::Arrival& arrival) {
  const std::uint64_t session = endpoint_.report(arrival.received).sessions;
  if (session != session_) {
    numbers_before_ += newest_;
    newest_ = 0;
    session_ = session;
  }
  newest_ = std::max(newest_, arrival.sequence);
}

void Station::collect() {
  while (const auto event = endpoint_.next_event()) {
    push_bounded(events_, *event);
    ++events_received_;
  }
  while (const auto object = endpoint_.next_bulk()) {
    BulkTally& tally = bulk_[static_cast<std::size_t>(object->kind)];
    ++tally.objects;
    tally.bytes += object->bytes.size();
  }
}

Station::Source Station::source() const {
  const auto& peer = endpoint_.peer();
  if (!peer) return Source::kNone;
  return peer->real_car ? Source::kCar : Source::kSimulation;
}

std::uint64_t Station::lost_packets() const {
  const std::uint64_t sent = numbers_before_ + newest_;
  return sent > rate_.packets() ? sent - rate_.packets() : 0;
}

double Station::loss() const {
  const std::uint64_t sent = numbers_before_ + newest_;
  return sent == 0 ? 0.0 : static_cast<double>(lost_packets()) / static_cast<double>(sent);
}

}  // namespace pitwall::link

// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/replay/sensor_arrival.hpp"

#include <algorithm>

#include "hil/replay/player.hpp"

namespace pitwall::benchmarks {
namespace {

// A record that arrived: when it was due since the start of the first pass, and when it came.
struct Arrival {
  Duration due{};
  Instant at{};
  std::size_t track = 0;
};

std::vector<replay::LoggedFrame> all_passes(const PlayedRecording& played) {
  std::vector<replay::LoggedFrame> out;
  for (unsigned pass = 0; pass < played.passes; ++pass)
    for (replay::LoggedFrame frame : played.frames) {
      frame.at.ns += (played.pass * std::int64_t{pass}).ns;
      out.push_back(frame);
    }
  return out;
}

struct DueDatagram {
  UtcTime at;
  const std::vector<std::uint8_t>* bytes;
};

std::vector<DueDatagram> all_passes(const PlayedRecording& played, std::size_t receiver) {
  std::vector<DueDatagram> out;
  for (unsigned pass = 0; pass < played.passes; ++pass)
    for (const SensorDatagram& datagram : played.datagrams)
      if (datagram.receiver == receiver)
        out.push_back({{datagram.at.ns + (played.pass * std::int64_t{pass}).ns}, &datagram.bytes});
  return out;
}

// How often each datagram occurs, compared: order plays no part.
void count_differences(const std::vector<DueDatagram>& wanted,
                       const std::vector<ReceivedDatagram>& arrived, DatagramCount& out) {
  std::vector<std::vector<std::uint8_t>> due, came, lost, extra;
  for (const DueDatagram& datagram : wanted) due.push_back(*datagram.bytes);
  for (const ReceivedDatagram& datagram : arrived) came.push_back(datagram.bytes);
  std::ranges::sort(due);
  std::ranges::sort(came);
  std::ranges::set_difference(due, came, std::back_inserter(lost));
  std::ranges::set_difference(came, due, std::back_inserter(extra));
  out.lost = lost.size();
  out.extra = extra.size();
}

DatagramCount count_of(const std::vector<DueDatagram>& wanted,
                       const std::vector<ReceivedDatagram>& arrived) {
  DatagramCount out{.wanted = wanted.size(), .arrived = arrived.size()};
  out.in_order = std::ranges::equal(
      wanted, arrived, [](const auto& a, const auto& b) { return *a.bytes == b.bytes; });
  count_differences(wanted, arrived, out);
  return out;
}

// Only of tracks that are complete and in order: record i of a track is the one that was due as
// number i.
TrackOrder order_of(std::vector<Arrival> all) {
  std::ranges::stable_sort(all, {}, &Arrival::due);
  TrackOrder out;
  for (std::size_t i = 1; i < all.size(); ++i) {
    if (all[i].track == all[i - 1].track) continue;
    ++out.changes;
    if (all[i].at > all[i - 1].at) ++out.shown;
  }
  // From the last one back: the first arrival of what is due later by more than a group.
  Instant first_later = Instant::max();
  std::size_t later = all.size();
  for (std::size_t i = all.size(); i-- > 0;) {
    while (later > 0 && all[later - 1].due > all[i].due + replay::kGroup)
      first_later = std::min(first_later, all[--later].at);
    if (all[i].at > first_later) ++out.broken;
  }
  return out;
}

}  // namespace

bool SensorArrival::is_whole() const {
  return frames.complete() && frames.in_order &&
         std::ranges::all_of(receivers, [](const DatagramCount& r) { return r.is_whole(); });
}

SensorArrival compare(const PlayedRecording& played, std::span<const can::ReceivedFrame> frames,
                      const ReceivedDatagrams& datagrams) {
  const std::vector<replay::LoggedFrame> due_frames = all_passes(played);
  SensorArrival out{.frames = replay::compare(due_frames, frames), .receivers = {}, .order = {}};
  std::array<std::vector<DueDatagram>, kReceivers> due;
  for (std::size_t receiver = 0; receiver < kReceivers; ++receiver) {
    due[receiver] = all_passes(played, receiver);
    out.receivers[receiver] = count_of(due[receiver], datagrams[receiver]);
  }
  if (!out.is_whole() || due_frames.empty()) return out;
  const UtcTime zero = due_frames.front().at;
  std::vector<Arrival> all;
  UtcTime stamp = zero;
  for (std::size_t i = 0; i < due_frames.size(); ++i) {
    stamp = std::max(stamp, due_frames[i].at);
    all.push_back({.due = {stamp.ns - zero.ns}, .at = frames[i].at, .track = kReceivers});
  }
  for (std::size_t receiver = 0; receiver < kReceivers; ++receiver)
    for (std::size_t i = 0; i < due[receiver].size(); ++i)
      all.push_back({.due = {due[receiver][i].at.ns - zero.ns},
                     .at = datagrams[receiver][i].at,
                     .track = receiver});
  out.order = order_of(std::move(all));
  return out;
}

}  // namespace pitwall::benchmarks

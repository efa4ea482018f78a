// Comparison of the arrivals of a recording, played in several passes, with the recording: frames
// and datagrams complete, each track in order, and all tracks in one common order.
//
//   order across tracks
//     due       frame  1.0 ms   datagram  1.5 ms
//     arrival          1.1 ms             1.6 ms   the order is shown
//                      1.9 ms             1.6 ms   broken: the frame arrived after a later due
//                      record
//     A player may send what is due within kGroup together, track by track: this does not count as
//     broken.
//
//   in     the log and the datagrams of one pass, its length, the number of passes; what sockets
//          received, with the kernel's stamps: of one clock, with one offset for all sockets, so
//          that their order is exactly the kernel's
//   out    frames as compare() counts them, over all passes; counts of each receiver; the order
//          across tracks if every track is complete and in order, otherwise nullopt
//   cost   O(n log n)
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "protocol/can/frame.hpp"
#include "tests/benchmarks/replay/compare.hpp"
#include "tests/benchmarks/replay/sensor_traffic.hpp"

namespace pitwall::benchmarks {

struct PlayedRecording {
  std::span<const replay::LoggedFrame> frames;
  std::span<const SensorDatagram> datagrams;
  Duration pass{};  // from the first record of one pass to the first of the next
  unsigned passes = 1;
};

struct ReceivedDatagram {
  Instant at;
  std::vector<std::uint8_t> bytes;
};
using ReceivedDatagrams = std::array<std::vector<ReceivedDatagram>, kReceivers>;

struct DatagramCount {
  std::uint64_t wanted = 0, arrived = 0, lost = 0, extra = 0;
  bool in_order = false;  // the whole sequence, byte by byte

  bool is_whole() const { return lost == 0 && extra == 0 && in_order; }
};

struct TrackOrder {
  std::uint64_t changes = 0;  // neighbours by due time on different tracks
  std::uint64_t shown = 0;    // of these: arrived in that order
  std::uint64_t broken = 0;   // records that arrived after a record that is due later

  bool is_kept() const { return shown > 0 && broken == 0; }
};

struct SensorArrival {
  replay::Comparison frames;
  std::array<DatagramCount, kReceivers> receivers;
  std::optional<TrackOrder> order;

  bool is_whole() const;
  bool order_is_kept() const { return order && order->is_kept(); }
};

SensorArrival compare(const PlayedRecording& played, std::span<const can::ReceivedFrame> frames,
                      const ReceivedDatagrams& datagrams);

}  // namespace pitwall::benchmarks

// Comparison of what arrived of a recording that was played in several passes with the recording:
// frames and datagrams complete, each track in order, and all tracks in one order.
//
//   order across tracks
//     due       frame  1.0 ms   datagram  1.5 ms
//     arrival          1.1 ms             1.6 ms   the order is shown
//                      1.9 ms             1.6 ms   broken: the frame came after what is due later
//     A player may send what is due within kGroup together, track by track: that breaks nothing.
//
//   in     the log and the datagrams of one pass, its length, how many there were; what sockets
//          received, with the kernel's stamps: of one clock, with one offset for all sockets, so
//          that their order is the kernel's and has no error
//   out    frames as compare() has them, against all passes; counts of each receiver; the order
//          across tracks, where every track is complete and in order: else there is none to judge
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
  std::uint64_t changes = 0;  // neighbours by due time that are of different tracks
  std::uint64_t shown = 0;    // of them: arrived in that order
  std::uint64_t broken = 0;   // records that arrived after one which is due later

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

// Attacker on the mesh without keys: receives every datagram, and sends forged ones to both ends.
//   in     a running VirtualRadio; how many datagrams to send
//   out    how many of them had an effect: it must be none
//   invariants
//          every forged datagram differs from each one that is under way; a replay repeats one that
//          is no longer under way
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <vector>

#include "protocol/vocabulary/random.hpp"
#include "tests/benchmarks/radio/virtual_radio.hpp"

namespace pitwall::radio {

enum class Forgery : std::uint8_t {
  kBitFlip,
  kTruncated,
  kExtended,
  kSpliced,     // the beginning of one datagram, the end of another
  kReplayed,    // unchanged
  kReflected,   // sent back to its sender
  kOldPhase,    // the bit of the key phase inverted
  kOldSession,  // from before the last restart
  kOtherCar,    // from another pair of ends
  kRandom
};
inline constexpr std::size_t kForgeries = 10;
const char* text_of(Forgery forgery);

struct ForgeryFigures {
  std::array<std::uint64_t, kForgeries> sent{};
  std::uint64_t accepted = 0;  // opened by one of the ends
  std::uint64_t sessions = 0;  // begun by the ends

  std::uint64_t total() const;
};

class PacketForger {
 public:
  // Receives from now on. The radio outlives this object, which takes its tap.
  PacketForger(VirtualRadio& radio, std::uint64_t seed);

  // Sends `count` datagrams now, of all kinds in turn, to both ends.
  void send(std::size_t count);
  // Sends `count` datagrams of one kind that is cheap to make (a changed tag), for a flood.
  void flood(std::size_t count);
  const ForgeryFigures& figures() const { return figures_; }

 private:
  using Bytes = std::vector<std::uint8_t>;

  std::uint64_t draw();
  const Bytes& received(bool down);
  Bytes forge(Forgery kind, bool at_base);
  void note_sessions();

  VirtualRadio& radio_;
  Random random_;
  std::array<std::deque<Bytes>, 2> received_;  // no longer under way, by direction
  std::array<std::deque<Bytes>, 2> fresh_;     // possibly under way
  std::array<std::deque<Bytes>, 2> before_;    // from sessions that are over
  std::vector<Bytes> foreign_;
  std::uint64_t last_sessions_ = 0, turn_ = 0;
  ForgeryFigures figures_;
};

// Runs the radio until `count` forged datagrams were sent, `each_ms` per millisecond. One end
// restarts from time to time, so that there are datagrams of earlier sessions.
ForgeryFigures run_forgeries(VirtualRadio& radio, std::uint64_t count, std::size_t each_ms);

}  // namespace pitwall::radio

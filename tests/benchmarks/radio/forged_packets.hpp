// Somebody on the mesh who has no keys: hears all, and sends what he likes to both ends.
//   in     a VirtualRadio that runs; how much he sends
//   out    how much of it had an effect: none may
//   invariants
//          everything that he sends differs from each datagram that is under way, or was delivered
//          before
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
  kSpliced,     // the beginning of one, the end of another
  kReplayed,    // as it was
  kReflected,   // sent back to where it came from
  kOldPhase,    // the key's phase turned over
  kOldSession,  // of before the last restart
  kOtherCar,    // of another pair of ends
  kRandom
};
inline constexpr std::size_t kForgeries = 10;
const char* text_of(Forgery forgery);

struct ForgeryFigures {
  std::array<std::uint64_t, kForgeries> sent{};
  std::uint64_t accepted = 0;  // opened by one of the ends
  std::uint64_t sessions = 0;  // begun by them

  std::uint64_t total() const;
};

class PacketForger {
 public:
  // Listens from now on; the radio must outlive it, and its tap is taken.
  PacketForger(VirtualRadio& radio, std::uint64_t seed);

  // So many datagrams now, of all kinds in turn, to both ends.
  void send(std::size_t count);
  // One kind of all, the cheapest to make: what a flood is made of.
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
  std::array<std::deque<Bytes>, 2> received_;  // delivered long ago, by direction
  std::array<std::deque<Bytes>, 2> fresh_;     // maybe under way
  std::array<std::deque<Bytes>, 2> before_;    // of sessions that are over
  std::vector<Bytes> foreign_;
  std::uint64_t last_sessions_ = 0, turn_ = 0;
  ForgeryFigures figures_;
};

// Runs the radio while `count` forged datagrams come, so many each millisecond; ends restart at
// times, so that there are sessions that are over.
ForgeryFigures run_forgeries(VirtualRadio& radio, std::uint64_t count, std::size_t each_ms);

}  // namespace pitwall::radio

// Memory and descriptors that are left to this process. Clients are refused before one of them is
// used up, so that the radio and the stops of those who are there go on.
//   in     limits and use of the process: RLIMIT_DATA, RLIMIT_AS, RLIMIT_NOFILE, memory.max of its
//          control group (v2)
//   out    why nobody more may come in
//   invariants
//          looked up each time: limits change while a program runs
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace pitwall::publishers::web {

// One bound of memory.
struct MemoryUse {
  std::string bound{};                  // as its owner knows it: "RLIMIT_DATA"
  std::uint64_t used = 0, allowed = 0;  // bytes
};

inline constexpr std::uint64_t kRoomToCome = 6'000'000;     // bytes: with less left nobody comes in
inline constexpr std::uint64_t kRoomPerNewcomer = 130'000;  // bytes: twice a console's measured
inline constexpr std::uint64_t kRoomToStay = 3'000'000;     // who left most unread has to go
inline constexpr int kKeptDescriptors = 16;  // for the radio, recordings, files of the console

// Those that there are, in no order.
std::vector<MemoryUse> memory_use();
// "memory: 70 of 80 MB (RLIMIT_DATA)" where less than `room` bytes are left; empty: there is room.
std::string short_of_memory(std::span<const MemoryUse> uses, std::uint64_t room);
// The descriptor is the newest, so that none lower was free.
std::string short_of_descriptors(int descriptor);

}  // namespace pitwall::publishers::web

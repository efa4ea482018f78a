// Memory and descriptors that are left to this process. New clients are refused before one of them
// is used up, so that the radio and the stops of connected clients go on.
//   in     limits and use of the process: RLIMIT_DATA, RLIMIT_AS, RLIMIT_NOFILE, memory.max of its
//          control group (v2)
//   out    the reason to refuse a new client
//   invariants
//          read each time, because limits change while a program runs
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace pitwall::publishers::web {

// One limit of memory, and its use.
struct MemoryUse {
  std::string bound{};                  // name of the limit: "RLIMIT_DATA"
  std::uint64_t used = 0, allowed = 0;  // bytes
};

inline constexpr std::uint64_t kMemoryToAccept = 6'000'000;  // bytes: with less, none is admitted
inline constexpr std::uint64_t kMemoryPerClient = 130'000;  // bytes: twice a console's measured use
inline constexpr std::uint64_t kMemoryToKeep = 3'000'000;   // bytes: with less, one is disconnected
inline constexpr int kKeptDescriptors = 16;  // for the radio, recordings, files of the console

// The limits that are set, in no particular order.
std::vector<MemoryUse> memory_use();
// "memory: 70 of 80 MB used (RLIMIT_DATA)" if less than `room` bytes are left, otherwise empty.
std::string short_of_memory(std::span<const MemoryUse> uses, std::uint64_t room);
// `descriptor`: the newest one, so that all lower numbers are in use.
std::string short_of_descriptors(int descriptor);

}  // namespace pitwall::publishers::web

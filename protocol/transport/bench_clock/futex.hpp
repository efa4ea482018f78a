// Sleep and wake of threads on a word in memory that processes share (futex(2)).
//   in     the word, which the waker changes before it calls wake()
//   out    sleep_while(): false if nobody woke the thread within the longest span
//   errors none: where the kernel refuses, both return at once
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>

#include "protocol/vocabulary/time.hpp"

namespace pitwall::transport {

bool sleep_while(const std::atomic<std::uint32_t>& word, std::uint32_t value, Duration longest);
void wake(std::atomic<std::uint32_t>& word);

}  // namespace pitwall::transport

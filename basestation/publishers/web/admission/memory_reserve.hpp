// Memory reserve for the case that an allocation of this process fails. It is released then, so
// that the allocation succeeds when it is tried again, and radio and stops go on while clients are
// disconnected. There is one per process, because operator new has one handler.
//   in     failing allocations of any thread (std::set_new_handler)
//   out    whether the reserve is still held
//   bound  kReserve bytes; a failure while it is released throws std::bad_alloc as usual
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

namespace pitwall::publishers::web {

inline constexpr std::size_t kReserve = 2'000'000;  // bytes

// Allocates the reserve, also after a release; false: the system has too little memory.
bool hold_reserve();
bool reserve_is_held();

}  // namespace pitwall::publishers::web

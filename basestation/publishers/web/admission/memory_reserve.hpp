// Memory kept back for the moment at which an allocation of this process fails: it is given up
// then, so that the allocation succeeds when it is tried again, and radio and stops go on while
// clients are sent away. One of the whole process, because operator new has one handler.
//   in     allocations of any thread that fail (std::set_new_handler)
//   out    whether the reserve was given up
//   bound  kReserve bytes; a failure while it is given up is std::bad_alloc as without it
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

namespace pitwall::publishers::web {

inline constexpr std::size_t kReserve = 2'000'000;  // bytes

// Takes the reserve, again if it was given up; false: the system has not so much.
bool hold_reserve();
bool reserve_is_held();

}  // namespace pitwall::publishers::web

// Counter of heap allocations per thread: operator new, malloc, Eigen's buffers. A program that
// does not include this file has glibc's own malloc.
//   out    number of blocks allocated since the thread began, or by one piece of work
//   invariants
//          any number of files of a program may include it, because its functions are weak
//   errors under AddressSanitizer, which has its own heap, nothing is counted and
//          kAllocationsCounted is false
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#if defined(__SANITIZE_ADDRESS__)
#define PITWALL_ADDRESS_SANITIZER
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define PITWALL_ADDRESS_SANITIZER
#endif
#endif

namespace pitwall::testing {

inline thread_local std::size_t allocation_count = 0;

#ifdef PITWALL_ADDRESS_SANITIZER
inline constexpr bool kAllocationsCounted = false;
#else
inline constexpr bool kAllocationsCounted = true;
#endif

template <class Work>
std::size_t allocations_of(Work&& work) {
  const std::size_t before = allocation_count;
  work();
  return allocation_count - before;
}

}  // namespace pitwall::testing

#ifndef PITWALL_ADDRESS_SANITIZER
// A program may replace malloc of glibc: https://www.gnu.org/software/libc/manual, 3.2.5.
// NOLINTBEGIN(bugprone-reserved-identifier): the names are glibc's.
extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* old, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);

[[gnu::weak]] void* malloc(std::size_t size) {
  ++pitwall::testing::allocation_count;
  return __libc_malloc(size);
}
[[gnu::weak]] void* calloc(std::size_t count, std::size_t size) {
  ++pitwall::testing::allocation_count;
  return __libc_calloc(count, size);
}
[[gnu::weak]] void* realloc(void* old, std::size_t size) {
  ++pitwall::testing::allocation_count;
  return __libc_realloc(old, size);
}
[[gnu::weak]] void* aligned_alloc(std::size_t alignment, std::size_t size) {
  ++pitwall::testing::allocation_count;
  return __libc_memalign(alignment, size);
}
}
// NOLINTEND(bugprone-reserved-identifier)
#endif

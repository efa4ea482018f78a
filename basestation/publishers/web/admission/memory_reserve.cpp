// SPDX-License-Identifier: Apache-2.0
#include "basestation/publishers/web/admission/memory_reserve.hpp"

#include <sys/mman.h>

#include <atomic>
#include <new>

namespace pitwall::publishers::web {
namespace {

// Mapped, not allocated: what is unmapped counts no longer against the limit of the process.
std::atomic<void*> reserve{nullptr};

void release_reserve() {
  void* const kept = reserve.exchange(nullptr);
  if (kept == nullptr) throw std::bad_alloc{};
  ::munmap(kept, kReserve);
}

}  // namespace

bool hold_reserve() {
  if (reserve_is_held()) return true;
  void* const fresh =
      ::mmap(nullptr, kReserve, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (fresh == MAP_FAILED) return false;
  void* none = nullptr;
  if (!reserve.compare_exchange_strong(none, fresh)) ::munmap(fresh, kReserve);
  std::set_new_handler(release_reserve);
  return true;
}

bool reserve_is_held() { return reserve.load() != nullptr; }

}  // namespace pitwall::publishers::web

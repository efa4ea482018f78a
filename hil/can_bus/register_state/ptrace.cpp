// The C library's ptrace() for a guest's kernel, as ptrace_library.hpp says. A process of its own:
// nothing of Pitwall is in it.
// SPDX-License-Identifier: Apache-2.0
#include <dlfcn.h>
#include <linux/elf.h>
#include <linux/ptrace.h>
#include <sys/types.h>
#include <sys/uio.h>

#include <array>
#include <cstdint>
#include <cstring>

namespace {

using Ptrace = long (*)(int request, pid_t process, void* address, void* data);

// The host's own is 11,008 bytes on a processor with AMX. It takes what it has of more.
constexpr std::size_t kMostBytes = 64 * 1024;

// What the caller has not stays zero, the initial state of what the guest cannot use. Static: the
// kernel of the guest calls from a stack of 16 KiB, never from two threads, and its interrupts do
// not change registers.
alignas(64) constinit std::array<std::uint8_t, kMostBytes> whole{};

long set_whole(Ptrace next, pid_t process, void* set, const iovec& part) {
  std::memcpy(whole.data(), part.iov_base, part.iov_len);
  iovec given{.iov_base = whole.data(), .iov_len = whole.size()};
  const long result = next(PTRACE_SETREGSET, process, set, &given);
  std::memset(whole.data(), 0, part.iov_len);  // the next caller may have less
  return result;
}

}  // namespace

// The C library's has the same arguments, declared as "...".
extern "C" long ptrace(int request, pid_t process, void* address, void* data) {
  static constinit Ptrace next = nullptr;
  if (next == nullptr) next = reinterpret_cast<Ptrace>(dlsym(RTLD_NEXT, "ptrace"));
  const bool sets_state =
      request == PTRACE_SETREGSET && reinterpret_cast<std::uintptr_t>(address) == NT_X86_XSTATE;
  if (sets_state) {
    const auto& part = *static_cast<const iovec*>(data);
    if (part.iov_len < kMostBytes) return set_whole(next, process, address, part);
  }
  return next(request, process, address, data);
}

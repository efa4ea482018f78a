// A shared library for a guest's kernel to be started with (LD_PRELOAD): its ptrace() completes the
// extended registers that the guest sets for one of its processes.
//
//   User-mode Linux 6.1 keeps 2,696 bytes of x87, SSE, AVX, AVX-512 and PKRU for each process; the
//   host has 11,008 where there is AMX. It cuts what is read to the 2,696, but refuses a cut state
//   that is set (EFAULT), and the guest dies at its first process: "ptrace set fp regs failed,
//   errno = 14". The library hands the host the 2,696 with zeros behind.
//
// Nothing is lost: the rest is AMX alone, and a guest refuses AMX to its processes (arch_prctl()
// fails, a tile instruction is SIGILL), so that all zeros is what it holds. Nothing is kept either:
// the guest itself copies its 2,696 bytes at fork, exec and exit. Where the host has no more, the
// zeros are not looked at, and every other request is passed on: the library is always there.
//
//   in     a folder for the library
//   out    bytes of an ELF file that needs the C library only; the environment to start with
//   errors Problem: a path that LD_PRELOAD has no way to write, or a file that cannot be written
//   source Linux 6.1 arch/x86/um/user-offsets.c (HOST_FP_SIZE), arch/x86/kernel/fpu/regset.c
//          (xstateregs_set), kernel/ptrace.c (ptrace_regset: more than the state is cut); Intel SDM
//          volume 1, 13.4.3 (standard format)
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "protocol/vocabulary/result.hpp"

namespace pitwall::can_bus {

std::string_view ptrace_library();
// Writes it there. "LD_PRELOAD=...", with what is preloaded already behind.
Result<std::string, Problem> preloaded_ptrace(const std::string& folder);

}  // namespace pitwall::can_bus

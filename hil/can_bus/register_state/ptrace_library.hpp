// Shared library that is preloaded (LD_PRELOAD) into a guest's kernel: its ptrace() completes the
// extended registers that the guest sets for one of its processes.
//
//   User-mode Linux 6.1 keeps 2,696 bytes of x87, SSE, AVX, AVX-512 and PKRU for each process; a
//   host with AMX has 11,008. The host truncates a read to the 2,696 bytes, but refuses to set a
//   truncated state (EFAULT), and the guest dies at its first process: "ptrace set fp regs failed,
//   errno = 14". The library passes the 2,696 bytes to the host, followed by zeros.
//
// No state is lost: the rest is AMX only, and a guest refuses AMX to its processes (arch_prctl()
// fails, a tile instruction gives SIGILL), so this state is all zeros. The library stores nothing:
// the guest itself copies its 2,696 bytes at fork, exec and exit. A host with a smaller state
// ignores the zeros, and every other request is passed on unchanged; therefore the library is
// always used.
//
//   in     a folder for the library
//   out    bytes of an ELF file that needs only the C library; the environment variable to start
//          with
//   errors Problem: a path that LD_PRELOAD cannot express, or a file that cannot be written
//   source Linux 6.1 arch/x86/um/user-offsets.c (HOST_FP_SIZE), arch/x86/kernel/fpu/regset.c
//          (xstateregs_set), kernel/ptrace.c (ptrace_regset: truncates what exceeds the state);
//          Intel SDM volume 1, 13.4.3 (standard format)
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "protocol/vocabulary/result.hpp"

namespace pitwall::can_bus {

std::string_view ptrace_library();
// Writes the library to the folder. Returns "LD_PRELOAD=...", followed by the libraries that are
// already preloaded.
Result<std::string, Problem> preloaded_ptrace(const std::string& folder);

}  // namespace pitwall::can_bus

// SPDX-License-Identifier: Apache-2.0
#include "hil/can_bus/register_state/ptrace_library.hpp"

#include <cstdlib>

#include "protocol/transport/file.hpp"

asm(".pushsection .rodata\n"
    "pitwall_ptrace_library: .incbin \"" PITWALL_PTRACE_LIBRARY
    "\"\n"
    "pitwall_ptrace_library_end:\n"
    ".popsection\n"
    ".globl pitwall_ptrace_library, pitwall_ptrace_library_end\n");

extern "C" const char pitwall_ptrace_library[], pitwall_ptrace_library_end[];

namespace pitwall::can_bus {

std::string_view ptrace_library() { return {pitwall_ptrace_library, pitwall_ptrace_library_end}; }

Result<std::string, Problem> preloaded_ptrace(const std::string& folder) {
  const std::string library = folder + "/ptrace.so";
  if (library.find_first_of(" :") != std::string::npos)
    return Unexpected{
        Problem{library,
                "a guest's library may have no space or colon in its path; set TMPDIR "
                "to another folder"}};
  const auto written = transport::write_file(library, ptrace_library(), 0700);
  if (!written) return Unexpected{written.error()};
  const char* others = std::getenv("LD_PRELOAD");
  return "LD_PRELOAD=" + library + (others == nullptr ? "" : ":" + std::string(others));
}

}  // namespace pitwall::can_bus

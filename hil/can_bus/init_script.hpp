// The first program of a guest: a shell script that loads CAN, makes the interfaces, runs one
// command and switches the machine off. Pure: text out; nothing runs here.
//   in     GuestPlan, and where on the host's file system the guest leaves its results
//   out    a script for /bin/sh (dash)
//   source Debian user-mode-linux 6.1; consoles: ttyS0 the line, ttyS1 output, ttyS2 errors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace pitwall::can_bus {

inline constexpr int kLeastMemory_mib = 96;  // below, the guest's own kernel is short of it

struct GuestPlan {
  std::vector<std::string> command{};      // runs as root in the same folder; sees our files
  std::vector<std::string> environment{};  // "NAME=value", on top of ours
  std::vector<std::string> interfaces{"vcan0"};
  // Runs beside the command and carries datagrams over /dev/ttyS0; empty: none. The command waits
  // until it has made the file that the script appends as its last argument.
  std::vector<std::string> line_command{};
  int memory_mib = 512;
};

// Files in the guest's own folder on the host.
inline constexpr std::string_view kExitCodeFile = "exit_code";
inline constexpr std::string_view kProblemFile = "problem";
inline constexpr std::string_view kLineReadyFile = "line_ready";

// One word of a shell command, whatever is in it.
std::string shell_quoted(std::string_view word);
// True for names that a shell can export.
bool is_exportable(std::string_view assignment);

std::string init_script(const GuestPlan& plan, std::string_view folder,
                        std::string_view working_folder, std::span<const std::string> environment);

}  // namespace pitwall::can_bus

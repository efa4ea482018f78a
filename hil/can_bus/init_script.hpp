// Init script of a guest: a shell script that loads CAN, creates the interfaces, runs one command
// and switches the machine off. Pure: the output is text, nothing is executed here.
//   in     GuestPlan, and the folder on the host's file system for the results of the guest
//   out    a script for /bin/sh (dash)
//   source Debian user-mode-linux 6.1; consoles: ttyS0 the line, ttyS1 output, ttyS2 errors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace pitwall::can_bus {

inline constexpr int kLeastMemory_mib = 96;  // with less, the guest kernel runs out of memory

struct GuestPlan {
  std::vector<std::string> command{};      // runs as root in the same folder, with the host's files
  std::vector<std::string> environment{};  // "NAME=value", added to our environment
  std::vector<std::string> interfaces{"vcan0"};
  // Runs in parallel with the command and carries datagrams over /dev/ttyS0; empty: none. The
  // command starts after line_command has created the file that the script appends as its last
  // argument.
  std::vector<std::string> line_command{};
  int memory_mib = 512;
};

// Files in the guest's own folder on the host.
inline constexpr std::string_view kExitCodeFile = "exit_code";
inline constexpr std::string_view kProblemFile = "problem";
inline constexpr std::string_view kLineReadyFile = "line_ready";

// Quotes any text as one word of a shell command.
std::string shell_quoted(std::string_view word);
// True if a shell can export the name.
bool is_exportable(std::string_view assignment);

std::string init_script(const GuestPlan& plan, std::string_view folder,
                        std::string_view working_folder, std::span<const std::string> environment);

}  // namespace pitwall::can_bus

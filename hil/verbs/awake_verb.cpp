// SPDX-License-Identifier: Apache-2.0
#include "hil/verbs/awake_verb.hpp"

#include <csignal>
#include <cstdio>

#include "hil/verbs/exit_code.hpp"
#include "protocol/transport/clock.hpp"
#include "protocol/transport/process.hpp"
#include "protocol/transport/virtual_machine.hpp"

namespace pitwall::verbs {
namespace {

constexpr const char* kUsage =
    "pitwall-hil awake COMMAND [ARG]...: runs COMMAND while no processor of this virtual machine "
    "sleeps\n";

}  // namespace

int awake_verb(std::span<const std::string> args) {
  if (args.empty() || args[0] == "--help") {
    std::fprintf(args.empty() ? stderr : stdout, "%s", kUsage);
    return args.empty() ? kExitUnusable : kExitPass;
  }
  // An interrupt of the terminal reaches the command, too; what it makes of it is the answer.
  auto stop = transport::StopSignal::install();
  if (!stop) return refuse(stop.error());
  const transport::KeepAwake awake;
  auto command = transport::Process::spawn({.argv = {args.begin(), args.end()}});
  if (!command) return refuse(command.error());
  constexpr Duration kLook = milliseconds(200);
  bool told = false;
  while (true) {
    if (const auto ended = command->wait_until(transport::monotonic_now() + kLook))
      return ended->shell_code();
    if (stop->raised() && !told) command->kill(SIGTERM);
    told = stop->raised();
  }
}

}  // namespace pitwall::verbs

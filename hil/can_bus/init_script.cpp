// SPDX-License-Identifier: Apache-2.0
#include "hil/can_bus/init_script.hpp"

#include <algorithm>
#include <cctype>

namespace pitwall::can_bus {
namespace {

// `fail` leaves the reason for the host. Without an exit code file the host knows that the command
// never ended by itself. Without the limit of real-time tasks: on one processor whose clock is the
// host's they were held up for 50 ms in a second in which the car, its guardian and the bench
// together needed half of it. The kernel's own thread that delivers frames comes before those tasks
// and has a queue of a second's frames: they starved it on a slow host, and by default vcan drops
// the 1,001st frame.
constexpr std::string_view kMachine = R"sh(
off() {
  sync
  poweroff -f
  echo 1 > /proc/sys/kernel/sysrq
  echo o > /proc/sysrq-trigger
  sleep 10
}
fail() {
  echo "$1" > "$folder/problem"
  off
}
mount -t proc proc /proc
mount -t sysfs sysfs /sys
[ -c /dev/ttyS1 ] || mount -t devtmpfs devtmpfs /dev
mkdir -p /dev/pts /dev/shm
mount -t devpts devpts /dev/pts
mount -t tmpfs tmpfs /dev/shm
mount -t tmpfs tmpfs /run
echo -1 > /proc/sys/kernel/sched_rt_runtime_us
echo 30000 > /proc/sys/net/core/netdev_max_backlog
for thread in $(pgrep -x ksoftirqd/0); do chrt -f -p 90 "$thread"; done
modules=/usr/lib/uml/modules/$(uname -r)/kernel
[ -d "$modules" ] || fail "no kernel modules in $modules"
load() { insmod "$modules/$1.ko" || fail "cannot load kernel module $1"; }
load drivers/net/can/dev/can-dev
load drivers/net/can/vcan
load drivers/net/can/vxcan
load net/can/can
load net/can/can-raw
load net/can/can-bcm
load net/can/can-gw
load drivers/net/can/slcan/slcan
load net/sched/sch_netem
ip link set lo up
for line in 0 1 2 3; do stty -F /dev/ttyS$line raw -echo; done
)sh";

// A signal takes the upper halves of AVX-512 registers from the process that it interrupts: of them
// User-mode Linux keeps no more than AVX then. The C library's string functions use all where they
// can, also in a handler; a printf() was seen to print its format instead. Without AVX-512 they do
// not. A program with AVX-512 code of its own has to keep it out of handlers.
constexpr std::string_view kStrings = R"sh(
    tunables="glibc.cpu.hwcaps=-AVX512F,-AVX512VL"
    export GLIBC_TUNABLES="${GLIBC_TUNABLES:+$GLIBC_TUNABLES:}$tunables"
)sh";

std::string quoted_words(std::span<const std::string> words) {
  std::string out;
  for (const std::string& word : words) out += (out.empty() ? "" : " ") + shell_quoted(word);
  return out;
}

std::string interface_lines(std::span<const std::string> interfaces) {
  std::string out;
  for (const std::string& name : interfaces) {
    const std::string quoted = shell_quoted(name);
    out += "ip link add dev " + quoted + " type vcan && ip link set " + quoted + " up || fail " +
           shell_quoted("cannot make interface " + name) + "\n";
  }
  return out;
}

// Half a minute is ample: the guest has one slow processor and the host may be busy.
std::string line_lines(const GuestPlan& plan) {
  if (plan.line_command.empty()) return {};
  return quoted_words(plan.line_command) + " \"$folder/" + std::string(kLineReadyFile) +
         "\" < /dev/null > /dev/ttyS2 2>&1 &\n"
         "tries=0\n"
         "while [ ! -e \"$folder/" +
         std::string(kLineReadyFile) +
         "\" ]; do\n"
         "  tries=$((tries + 1))\n"
         "  [ $tries -gt 600 ] && fail 'the line to the host did not come up'\n"
         "  sleep 0.05\n"
         "done\n";
}

}  // namespace

std::string shell_quoted(std::string_view word) {
  std::string out = "'";
  for (const char c : word) {
    if (c == '\'')
      out += "'\\''";
    else
      out += c;
  }
  return out + "'";
}

bool is_exportable(std::string_view assignment) {
  const std::size_t equals = assignment.find('=');
  if (equals == 0 || equals == std::string_view::npos) return false;
  const std::string_view name = assignment.substr(0, equals);
  const auto is_name_character = [](char c) {
    return c == '_' || std::isalnum(static_cast<unsigned char>(c)) != 0;
  };
  return std::isdigit(static_cast<unsigned char>(name[0])) == 0 &&
         std::all_of(name.begin(), name.end(), is_name_character);
}

std::string init_script(const GuestPlan& plan, std::string_view folder,
                        std::string_view working_folder, std::span<const std::string> environment) {
  std::string out = "#!/bin/sh\n";
  out += "export PATH=/usr/sbin:/usr/bin:/sbin:/bin\n";
  out += "folder=" + shell_quoted(folder) + "\n";
  out += kMachine;
  out += interface_lines(plan.interfaces);
  out += line_lines(plan);
  out += "cd " + shell_quoted(working_folder) + " || fail 'no working folder'\n";
  // The environment is set in the command's own shell: it must not change how this script works.
  // Output goes through cat, so that the command sees a pipe and `cat` waits for the last byte.
  out += "(\n  (\n";
  for (const auto* list : {&environment})
    for (const std::string& assignment : *list)
      if (is_exportable(assignment)) {
        const std::size_t equals = assignment.find('=');
        out += "    export " + assignment.substr(0, equals) + "=" +
               shell_quoted(std::string_view(assignment).substr(equals + 1)) + "\n";
      }
  out += kStrings.substr(1);
  out += "    exec " + quoted_words(plan.command) + "\n";
  out += "  ) < /dev/null 2> /dev/ttyS2\n";
  out += "  echo $? > \"$folder/" + std::string(kExitCodeFile) + "\"\n";
  out += ") | cat > /dev/ttyS1\n";
  // Setting a tty's mode waits until what was written has left.
  out += "for line in 1 2; do stty -F /dev/ttyS$line raw -echo; done\n";
  out += "off\n";
  return out;
}

}  // namespace pitwall::can_bus

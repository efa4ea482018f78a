// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/live/machine.hpp"

#include <fcntl.h>
#include <sys/mount.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <time.h>
#include <unistd.h>

#include "hil/bench/live/virtual_machine.hpp"
#include "protocol/transport/clock.hpp"
#include "protocol/transport/file.hpp"
#include "protocol/transport/posix_call.hpp"

namespace pitwall::bench {
namespace {

using faults::BenchFault;
using faults::BenchFaultKind;
using transport::posix_call;

constexpr const char* kDiskOptions = "size=8m,mode=0755";

Result<bool, Problem> step_clock(Duration by) {
  const std::int64_t to_ns = transport::utc_now().ns + by.ns;
  timespec to{};
  to.tv_sec = static_cast<time_t>(to_ns / kNanosecondsPerSecond);
  to.tv_nsec = static_cast<long>(to_ns % kNanosecondsPerSecond);
  const auto set = posix_call([&] { return clock_settime(CLOCK_REALTIME, &to); });
  if (!set.ok()) return refuse("clock_step", set.reason());
  return true;
}

// To the last byte: what the file system says is free goes to one file.
Result<bool, Problem> fill(const std::string& disk, const std::string& filler) {
  struct statvfs room {};
  const auto asked = posix_call([&] { return statvfs(disk.c_str(), &room); });
  if (!asked.ok()) return refuse(disk, asked.reason());
  const transport::FileDescriptor file(
      posix_call([&] { return open(filler.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0600); }));
  if (!file.valid()) return refuse(filler, "cannot be created");
  const auto bytes = static_cast<off_t>(room.f_bavail * room.f_frsize);
  const auto taken = posix_call([&] { return fallocate(file.get(), 0, 0, bytes); });
  if (!taken.ok()) return refuse(filler, taken.reason());
  return true;
}

std::string words(const BenchFault& fault, bool begins) {
  if (fault.kind == BenchFaultKind::kLogDiskFull)
    return begins ? "disk of the logs full" : "disk of the logs has room again";
  const double by_s = begins ? fault.value : -fault.value;
  return "clock of the day stepped by " + std::to_string(by_s) + " s";
}

}  // namespace

bool is_machine_fault(BenchFaultKind kind) {
  return kind == BenchFaultKind::kClockStep || kind == BenchFaultKind::kLogDiskFull;
}

Result<bool, Problem> mount_disk(const std::string& folder) {
  if (!is_guest()) return refuse("log_disk_full", "possible only in a guest: bus exec --guest");
  const auto made = posix_call([&] { return mkdir(folder.c_str(), 0755); });
  if (!made.ok() && made.error != EEXIST) return refuse(folder, made.reason());
  const auto mounted =
      posix_call([&] { return mount("disk", folder.c_str(), "tmpfs", 0, kDiskOptions); });
  if (!mounted.ok()) return refuse(folder, mounted.reason());
  return true;
}

Result<Machine, Problem> Machine::take(std::span<const BenchFault> faults,
                                       const std::string& disk) {
  Machine machine;
  machine.disk_ = disk;
  for (const BenchFault& fault : faults) {
    if (!is_machine_fault(fault.kind)) continue;
    const std::string kind(faults::row_of(fault.kind).name);
    if (!is_guest())
      return refuse(
          kind, "possible only in a guest, because it changes the whole machine: bus exec --guest");
    if (fault.kind == BenchFaultKind::kLogDiskFull && disk.empty())
      return refuse(kind, "this run has no disk of its own to fill");
    machine.actions_.push_back({.fault = fault});
  }
  return machine;
}

std::optional<Problem> Machine::advance(Instant now) {
  for (ProcessAction& action : actions_) {
    const BenchFault& fault = action.fault;
    const bool active = faults::active(fault, now);
    const bool begins = !action.begun && active, ends = action.begun && !action.ended && !active;
    if (!begins && !ends) continue;
    const auto carried_out = begins ? begin(fault) : undo(fault);
    if (!carried_out) return carried_out.error();
    (begins ? action.begun : action.ended) = true;
    done_.push_back({now, words(fault, begins)});
  }
  return std::nullopt;
}

Result<bool, Problem> Machine::begin(const BenchFault& fault) {
  if (fault.kind == BenchFaultKind::kClockStep) return step_clock(from_seconds(fault.value));
  return fill(disk_, filler());
}

Result<bool, Problem> Machine::undo(const BenchFault& fault) {
  if (fault.kind == BenchFaultKind::kClockStep) return step_clock(from_seconds(-fault.value));
  const auto removed = posix_call([this] { return unlink(filler().c_str()); });
  if (!removed.ok()) return refuse(filler(), removed.reason());
  return true;
}

}  // namespace pitwall::bench

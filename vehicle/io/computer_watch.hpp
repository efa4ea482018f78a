// Monitor of the car's computer: processor load, memory and temperature. It reads once a second in
// a thread of its own, because a read of kernel files may block.
//   out    processor_share: of all processors over the last second, 0 .. 1; memory_mib: in use,
//          without caches; temperature_c: the hottest thermal zone. Unset if the kernel does not
//          provide it
//   errors none; a file that is missing or has another format leaves its value unset
//   cost   newest(): three atomic loads
//   source proc(5): /proc/stat, /proc/meminfo; sysfs-class-thermal
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <thread>

#include "protocol/transport/posix_call.hpp"
#include "protocol/vocabulary/units.hpp"

namespace pitwall::io {

struct ProcessorTime {
  std::uint64_t busy = 0, all = 0;  // jiffies of all processors since boot
};
// The first line of /proc/stat: "cpu  user nice system idle iowait irq softirq steal ...".
std::optional<ProcessorTime> processor_time_of(std::string_view stat);
// Unset if no time passed or the counters decreased.
double share_between(const ProcessorTime& before, const ProcessorTime& after);
// MemTotal minus MemAvailable of /proc/meminfo.
double memory_in_use_mib(std::string_view meminfo);
// File of a thermal zone, in thousandths of a degree Celsius.
double temperature_of(std::string_view zone);

struct ComputerReport {
  double processor_share = kUnset, memory_mib = kUnset, temperature_c = kUnset;
};

class ComputerWatch {
 public:
  // `proc` and `zones`: other folders in tests. Returns nullptr if the event file that ends the
  // thread cannot be created.
  static std::unique_ptr<ComputerWatch> start(std::string proc = "/proc",
                                              std::string zones = "/sys/class/thermal");
  ~ComputerWatch();
  ComputerWatch(const ComputerWatch&) = delete;
  ComputerWatch& operator=(const ComputerWatch&) = delete;

  ComputerReport newest() const {
    return {share_.load(), memory_mib_.load(), temperature_c_.load()};
  }
  // For tests: number of complete readings.
  std::uint64_t readings() const { return readings_.load(); }

 private:
  ComputerWatch(std::string proc, std::string zones, transport::FileDescriptor wake_fd);
  void serve();
  void read();
  double hottest() const;

  std::string proc_, zones_;
  transport::FileDescriptor wake_fd_;
  std::optional<ProcessorTime> before_;  // of the thread
  std::atomic<double> share_{kUnset}, memory_mib_{kUnset}, temperature_c_{kUnset};
  std::atomic<std::uint64_t> readings_{0};
  std::atomic<bool> end_{false};
  std::thread thread_;
};

}  // namespace pitwall::io

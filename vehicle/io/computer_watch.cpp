// SPDX-License-Identifier: Apache-2.0
#include "vehicle/io/computer_watch.hpp"

#include <sys/eventfd.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <system_error>
#include <utility>

#include "protocol/transport/clock.hpp"
#include "protocol/transport/file.hpp"
#include "protocol/transport/readiness.hpp"

namespace pitwall::io {
namespace {

constexpr Duration kSamplePeriod = seconds(1);
constexpr int kZones = 32;                                  // more than any computer of a car has
constexpr std::size_t kTimes = 8, kIdle = 3, kWaiting = 4;  // columns of /proc/stat
constexpr double kKibPerMib = 1024.0, kThousandths = 1e-3;

// The number at the beginning of the text, after blanks; the rest follows it.
std::optional<std::int64_t> take_number(std::string_view& text) {
  text.remove_prefix(std::min(text.find_first_not_of(' '), text.size()));
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{}) return std::nullopt;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return value;
}

double kib_of(std::string_view meminfo, std::string_view name) {
  const std::size_t at = meminfo.find(name);
  if (at == std::string_view::npos) return kUnset;
  std::string_view rest = meminfo.substr(at + name.size());
  const auto value = take_number(rest);
  return value ? static_cast<double>(*value) : kUnset;
}

}  // namespace

std::optional<ProcessorTime> processor_time_of(std::string_view stat) {
  if (!stat.starts_with("cpu ")) return std::nullopt;
  stat.remove_prefix(3);
  ProcessorTime time;
  for (std::size_t column = 0; column < kTimes; ++column) {
    const auto value = take_number(stat);
    if (!value || *value < 0) return std::nullopt;
    const auto jiffies = static_cast<std::uint64_t>(*value);
    time.all += jiffies;
    if (column != kIdle && column != kWaiting) time.busy += jiffies;
  }
  return time;
}

double share_between(const ProcessorTime& before, const ProcessorTime& after) {
  if (after.all <= before.all || after.busy < before.busy) return kUnset;
  const double share =
      static_cast<double>(after.busy - before.busy) / static_cast<double>(after.all - before.all);
  return std::min(share, 1.0);
}

double memory_in_use_mib(std::string_view meminfo) {
  const double used_kib = kib_of(meminfo, "MemTotal:") - kib_of(meminfo, "MemAvailable:");
  return used_kib >= 0.0 ? used_kib / kKibPerMib : kUnset;
}

double temperature_of(std::string_view zone) {
  const auto value = take_number(zone);
  return value ? static_cast<double>(*value) * kThousandths : kUnset;
}

std::unique_ptr<ComputerWatch> ComputerWatch::start(std::string proc, std::string zones) {
  transport::FileDescriptor wake_fd(
      transport::posix_call([] { return eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK); }));
  if (!wake_fd.valid()) return nullptr;
  return std::unique_ptr<ComputerWatch>(
      new ComputerWatch(std::move(proc), std::move(zones), std::move(wake_fd)));
}

ComputerWatch::ComputerWatch(std::string proc, std::string zones, transport::FileDescriptor wake_fd)
    : proc_(std::move(proc)), zones_(std::move(zones)), wake_fd_(std::move(wake_fd)) {
  thread_ = std::thread([this] { serve(); });
}

ComputerWatch::~ComputerWatch() {
  end_.store(true);
  eventfd_write(wake_fd_.get(), 1);
  thread_.join();
}

void ComputerWatch::serve() {
  Instant next = transport::monotonic_now();
  while (!end_.load()) {
    if (transport::monotonic_now() >= next) {
      read();
      next += kSamplePeriod;
    }
    const int watched[] = {wake_fd_.get()};
    transport::wait_readable(watched, next);
  }
}

void ComputerWatch::read() {
  const auto stat = transport::read_file(proc_ + "/stat");
  const auto now = stat ? processor_time_of(*stat) : std::nullopt;
  share_.store(now && before_ ? share_between(*before_, *now) : kUnset);
  before_ = now;
  const auto memory = transport::read_file(proc_ + "/meminfo");
  memory_mib_.store(memory ? memory_in_use_mib(*memory) : kUnset);
  temperature_c_.store(hottest());
  ++readings_;
}

double ComputerWatch::hottest() const {
  double hottest_c = kUnset;
  for (int zone = 0; zone < kZones; ++zone) {
    const auto text =
        transport::read_file(zones_ + "/thermal_zone" + std::to_string(zone) + "/temp");
    if (!text) break;  // zones are numbered without gaps
    const double temperature_c = temperature_of(*text);
    if (std::isnan(hottest_c) || temperature_c > hottest_c) hottest_c = temperature_c;
  }
  return hottest_c;
}

}  // namespace pitwall::io

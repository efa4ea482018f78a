// SPDX-License-Identifier: Apache-2.0
#include "hil/can_bus/own_hub.hpp"

#include <csignal>

#include "protocol/transport/can/unix_bus.hpp"
#include "protocol/transport/clock.hpp"

namespace pitwall::can_bus {
namespace {

constexpr Duration kStartLimit = seconds(5), kStopLimit = seconds(2);
constexpr Duration kPollPeriod = milliseconds(5);

}  // namespace

Result<std::optional<OwnHub>, Problem> OwnHub::start(const std::string& program,
                                                     const std::string& bus,
                                                     const std::string& clock) {
  if (!transport::is_unix_bus(bus)) return std::optional<OwnHub>{};
  const auto address = transport::unix_bus_address(bus);
  if (!address) return Unexpected{address.error()};
  if (transport::hub_serves(*address)) return std::optional<OwnHub>{};
  transport::ProcessPlan plan{.argv = {program, "bus", "hub", bus}};
  if (!clock.empty()) plan.argv.insert(plan.argv.end(), {"--clock", clock});
  auto process = transport::Process::spawn(plan);
  if (!process) return Unexpected{process.error()};
  const Instant limit = transport::monotonic_now() + kStartLimit;
  while (!process->poll() && transport::monotonic_now() < limit) {
    if (transport::hub_serves(*address)) return std::optional(OwnHub{*std::move(process)});
    transport::sleep_until(transport::monotonic_now() + kPollPeriod);
  }
  return Unexpected{Problem{bus, "the hub of this bus did not start"}};
}

OwnHub::~OwnHub() {
  if (process_.pid() < 0) return;  // moved from
  process_.kill(SIGTERM);
  static_cast<void>(process_.wait_until(transport::monotonic_now() + kStopLimit));
}

}  // namespace pitwall::can_bus

// SPDX-License-Identifier: Apache-2.0
#include "basestation/service/link_monitor.hpp"

#include <array>

#include "protocol/telemetry/packet/header.hpp"

namespace pitwall::service {
namespace {

using telemetry::field;

constexpr double kBytesPerKbit = 125.0;
constexpr std::array kBudgetUse{field("radio.budget_use_0"), field("radio.budget_use_1")};

}  // namespace

state::LinkFigures LinkMonitor::measure(const link::Station& station,
                                        const state::VehicleState& vehicle, Instant now) {
  const telemetry::LinkReport report = station.report(now);
  meter_.note(link::count_of(report, station.rate().packets(), station.lost_packets()), now,
              report.round_trip ? report.round_trip->milliseconds() : kUnset);
  state::LinkFigures figures;
  if (station.rate().ever()) figures.received = now - station.rate().since_last(now);
  figures.loss_1s = meter_.loss(seconds(1));
  figures.down_loss = meter_.loss(seconds(5));
  figures.loss_30s = meter_.loss(seconds(30));
  const state::FieldView up_loss = vehicle.view(field("radio.loss_0"), now);
  if (state::usable(up_loss)) figures.up_loss = up_loss.value;
  if (report.round_trip) figures.round_trip_ms = report.round_trip->milliseconds();
  figures.jitter_ms = report.paths[0].received.jitter.milliseconds();
  figures.packets_hz = station.rate().rate_hz(now);
  figures.threats = report.threats.bits;
  figures.down_kbit_s = 0.0;
  figures.up_kbit_s = 0.0;
  figures.down_cap_kbit_s = 0.0;
  const double overhead_kbit_s =  // the car's budget counts IP and UDP, the link's figures do not
      figures.packets_hz * telemetry::kIpUdpOverhead / kBytesPerKbit;
  for (std::size_t path = 0; path < station.paths(); ++path) {
    const telemetry::PathFigures& down = report.paths[path].received;
    const double down_kbit_s = down.rate_bytes_per_s / kBytesPerKbit;
    const state::FieldView use = vehicle.view(kBudgetUse[path], now);
    if (state::usable(use)) {
      meter_.note_use(path, (down_kbit_s + overhead_kbit_s) / (1.0 - down.loss), use.value);
    }
    figures.down_kbit_s += down_kbit_s;
    figures.down_cap_kbit_s += meter_.down_cap_kbit_s(path);
    figures.up_kbit_s += meter_.path(path, seconds(5)).up_kbit_s;
  }
  return figures;
}

}  // namespace pitwall::service

// SPDX-License-Identifier: Apache-2.0
// CAN bus and local reports of a pitwall-vehicle that stands: standing_car BUS. Serves the CAN bus
// BUS (unix:PATH), sends wheel speeds of zero on it and receives the car's local reports. Ends when
// its input does. Prints, with times of the monotonic clock in ns:
//   port PORT        where --local-report goes
//   report TIME STOP AGE_MS ACCEPTED REFUSED
//                    STOP: level of the stop latch; AGE_MS: of the newest packet of the base, -1
//                    before the first; packets of the base that were accepted, and datagrams
//                    that were refused
#include <unistd.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <span>
#include <string>
#include <vector>

#include "protocol/can/av21.hpp"
#include "protocol/telemetry/state_packet.hpp"
#include "protocol/transport/can/can_socket.hpp"
#include "protocol/transport/can/unix_can_hub.hpp"
#include "protocol/transport/clock.hpp"
#include "protocol/transport/readiness.hpp"
#include "protocol/transport/udp_socket.hpp"

namespace pitwall {
namespace {

using telemetry::field;

constexpr Duration kTurn = milliseconds(2), kWheelPeriod = milliseconds(10);

double or_minus_one(double value) { return std::isfinite(value) ? value : -1.0; }

void print(const telemetry::StatePacket& report, Instant at) {
  const telemetry::Values& v = report.values;
  std::printf("report %lld %.0f %.0f %.0f %.0f\n", static_cast<long long>(at.ns),
              or_minus_one(v[field("mode.stop_latch")]),
              or_minus_one(v[field("uplink.link_age")] * 1e3),
              or_minus_one(v[field("radio.heartbeats")]),
              or_minus_one(v[field("radio.heartbeats_refused")]));
}

bool input_ended(const std::array<int, 1>& input) {
  return transport::wait_readable(input, transport::monotonic_now()) != 0;
}

void serve(transport::UnixCanHub& hub, transport::CanSocket& bus, transport::UdpSocket& reports) {
  std::vector<transport::UdpDatagram> batch(transport::UdpSocket::kBatch);
  std::vector<can::ReceivedFrame> unread(transport::CanSocket::kBatch);
  can::Frame standing{};
  can::EncodeCounters encoded;
  const can::av21::WheelSpeedReport wheels{0.0, 0.0, 0.0, 0.0};
  if (!can::av21::encode(wheels, standing, encoded)) return;
  Instant next = transport::monotonic_now();
  while (!input_ended({STDIN_FILENO})) {
    hub.serve(transport::monotonic_now() + kTurn);
    while (bus.receive(unread) > 0) continue;
    if (const Instant now = transport::monotonic_now(); now >= next) {
      bus.send({&standing, 1});
      next = now + kWheelPeriod;
    }
    const std::size_t n = reports.receive(batch);
    for (const transport::UdpDatagram& datagram : std::span(batch).first(n)) {
      const auto report = telemetry::parse(datagram.payload());
      if (report) print(*report, datagram.at);
    }
    std::fflush(stdout);
  }
}

int refuse(const Problem& problem) {
  std::fprintf(stderr, "%s\n", to_string(problem).c_str());
  return 1;
}

int run(const std::string& interface) {
  auto hub = transport::UnixCanHub::open(interface);
  if (!hub) return refuse(hub.error());
  auto bus = transport::CanSocket::open(interface);
  if (!bus) return refuse(bus.error());
  auto reports = transport::UdpSocket::bind({});
  if (!reports) return refuse(reports.error());
  std::printf("port %d\n", reports->local().port);
  std::fflush(stdout);
  serve(**hub, *bus, *reports);
  return 0;
}

}  // namespace
}  // namespace pitwall

int main(int argc, char** argv) { return argc == 2 ? pitwall::run(argv[1]) : 2; }

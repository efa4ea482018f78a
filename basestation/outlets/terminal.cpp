// SPDX-License-Identifier: Apache-2.0
#include "basestation/outlets/terminal.hpp"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "basestation/outlets/text_view.hpp"
#include "protocol/transport/clock.hpp"
#include "protocol/transport/readiness.hpp"

namespace pitwall::outlets {
namespace {

constexpr Instant kForever{INT64_MAX};
constexpr std::uint32_t kStopBit = 1U << 1U;  // of the second watched descriptor
constexpr int kMaxRounds = 64;  // a flood must not keep screen and stop signal waiting

using Car = std::optional<transport::UdpAddress>;  // who sent the last packet that was accepted

void drain(transport::UdpSocket& socket, std::vector<transport::UdpDatagram>& batch,
           intake::Station& station, Car& car) {
  for (int round = 0; round < kMaxRounds; ++round) {
    const std::size_t n = socket.receive(batch);
    for (std::size_t i = 0; i < n; ++i)
      if (station.take(batch[i].payload(), batch[i].at)) car = batch[i].from;
    if (n < batch.size()) return;
  }
}

void answer(transport::UdpSocket& socket, intake::Station& station, const Car& car) {
  const auto heartbeat = station.uplink().poll(transport::monotonic_now());
  if (!heartbeat.empty() && car) station.uplink().note(socket.send_to(*car, heartbeat));
}

void show(intake::Station& station, const TerminalOptions& options, std::FILE* terminal) {
  const Instant now = transport::monotonic_now();
  station.advance(now);
  const std::string screen = text_view(station, now, {.ansi = !options.plain});
  std::fwrite(screen.data(), 1, screen.size(), terminal);
  std::fflush(terminal);
}

}  // namespace

void run_terminal(transport::UdpSocket& socket, int stop, const TerminalOptions& options,
                  intake::Station& station, std::FILE* terminal) {
  std::vector<transport::UdpDatagram> batch(transport::UdpSocket::kBatch);
  const Instant start = transport::monotonic_now();
  const Instant end = options.duration.ns > 0 ? start + options.duration : kForever;
  Instant next_screen = options.text ? start : kForever;
  Car car;
  const int watched[] = {socket.fd(), stop};
  bool stopped = false;
  while (!stopped) {
    const Instant next_answer = station.uplink().due().value_or(kForever);
    const auto ready = transport::wait_readable(watched, std::min({next_screen, next_answer, end}));
    drain(socket, batch, station, car);
    answer(socket, station, car);
    const Instant now = transport::monotonic_now();
    if (now >= next_screen) {
      show(station, options, terminal);
      next_screen = now + options.refresh;
    }
    stopped = (ready & kStopBit) != 0 || now >= end;
  }
  if (options.text) show(station, options, terminal);
}

}  // namespace pitwall::outlets

// SPDX-License-Identifier: Apache-2.0
#include "basestation/outlets/terminal.hpp"

#include <algorithm>
#include <cstdint>
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

void drain(transport::UdpSocket& socket, std::vector<transport::UdpDatagram>& batch,
           intake::Station& station) {
  for (int round = 0; round < kMaxRounds; ++round) {
    const std::size_t n = socket.receive(batch);
    for (std::size_t i = 0; i < n; ++i) station.take(batch[i].payload(), batch[i].at);
    if (n < batch.size()) return;
  }
}

void show(intake::Station& station, const TerminalOptions& options, std::FILE* terminal) {
  const Instant now = transport::monotonic_now();
  station.advance(now);
  const std::string screen = text_view(station.picture(), station.counters(), station.link(), now,
                                       {.ansi = !options.plain});
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
  const int watched[] = {socket.fd(), stop};
  bool stopped = false;
  while (!stopped) {
    const auto ready = transport::wait_readable(watched, std::min(next_screen, end));
    drain(socket, batch, station);
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

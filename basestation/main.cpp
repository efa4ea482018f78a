// pitwall-base: receives the car's telemetry and shows it. Wiring only.
// SPDX-License-Identifier: Apache-2.0
#include <csignal>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include <sys/signalfd.h>

#include "basestation/arguments.hpp"
#include "basestation/station.hpp"
#include "protocol/transport/clock.hpp"
#include "protocol/transport/file.hpp"
#include "protocol/transport/posix_call.hpp"
#include "protocol/transport/readiness.hpp"
#include "protocol/transport/udp_socket.hpp"

namespace pitwall::basestation {
namespace {

constexpr Instant kForever{INT64_MAX};
constexpr int kMaxRounds = 64;  // a flood must not keep screen and stop signal waiting
constexpr std::uint32_t kStopBit = 1U << 1U;  // of the second watched descriptor

// SIGINT and SIGTERM become readable instead of interrupting.
transport::FileDescriptor stop_signals() {
  sigset_t set;
  sigemptyset(&set);
  sigaddset(&set, SIGINT);
  sigaddset(&set, SIGTERM);
  sigprocmask(SIG_BLOCK, &set, nullptr);
  return transport::FileDescriptor{
      transport::posix_call([&] { return ::signalfd(-1, &set, SFD_CLOEXEC | SFD_NONBLOCK); })};
}

void drain(transport::UdpSocket& socket, std::vector<transport::UdpDatagram>& batch,
           Station& station) {
  for (int round = 0; round < kMaxRounds; ++round) {
    const std::size_t n = socket.receive(batch);
    for (std::size_t i = 0; i < n; ++i) station.take(batch[i].payload(), batch[i].at);
    if (n < batch.size()) return;
  }
}

void show(Station& station, const Arguments& arguments) {
  const std::string screen = station.screen(transport::monotonic_now(), !arguments.plain);
  std::fwrite(screen.data(), 1, screen.size(), stdout);
  std::fflush(stdout);
}

void receive_until_stopped(transport::UdpSocket& socket, const Arguments& arguments,
                           const transport::FileDescriptor& stop, Station& station) {
  std::vector<transport::UdpDatagram> batch(transport::UdpSocket::kBatch);
  const Instant start = transport::monotonic_now();
  const Instant end = arguments.duration.ns > 0 ? start + arguments.duration : kForever;
  const Duration refresh = from_seconds(1.0 / arguments.refresh_hz);
  Instant next_screen = arguments.text ? start : kForever;
  const int watched[] = {socket.fd(), stop.get()};
  while (true) {
    const auto ready = transport::wait_readable(watched, next_screen < end ? next_screen : end);
    drain(socket, batch, station);
    const Instant now = transport::monotonic_now();
    if (now >= next_screen) {
      show(station, arguments);
      next_screen = transport::next_tick(next_screen, refresh, now).deadline;
      if (next_screen <= now) next_screen += refresh;
    }
    if ((ready & kStopBit) != 0 || now >= end) return;
  }
}

int run(const Arguments& arguments) {
  const transport::FileDescriptor stop = stop_signals();
  auto socket = transport::UdpSocket::bind(arguments.listen);
  if (!socket) {
    std::fprintf(stderr, "pitwall-base: %s\n", to_string(socket.error()).c_str());
    return 1;
  }
  std::fprintf(stderr, "pitwall-base: listening at %s\n", to_string(socket->local()).c_str());
  const auto station = std::make_unique<Station>();
  receive_until_stopped(*socket, arguments, stop, *station);
  if (arguments.text) show(*station, arguments);
  if (arguments.json_path.empty()) return 0;
  const auto written =
      transport::write_file(arguments.json_path, station->summary(transport::monotonic_now()));
  if (written) return 0;
  std::fprintf(stderr, "pitwall-base: %s\n", to_string(written.error()).c_str());
  return 1;
}

}  // namespace
}  // namespace pitwall::basestation

int main(int argc, char** argv) {
  const auto arguments = pitwall::basestation::parse_arguments(argc, argv);
  if (arguments) return pitwall::basestation::run(*arguments);
  const auto& refusal = arguments.error();
  std::fputs(refusal.text.c_str(), refusal.exit_code == 0 ? stdout : stderr);
  return refusal.exit_code;
}

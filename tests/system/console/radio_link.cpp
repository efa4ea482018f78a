// SPDX-License-Identifier: Apache-2.0
// An emulated radio between a car and a base, in real time: radio_link BASE_PORT AT FOR SECONDS.
// Nothing passes from AT seconds on for FOR seconds. Prints the port to which the car sends.
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "hil/bench/live/radio_path.hpp"
#include "protocol/transport/clock.hpp"
#include "protocol/transport/readiness.hpp"
#include "tests/support/test_clock.hpp"

namespace pitwall {
namespace {

// Of a socket that is gone again.
Result<std::uint16_t, Problem> free_port() {
  auto socket = transport::UdpSocket::bind({.ip = kLoopbackIp});
  if (!socket) return Unexpected{socket.error()};
  return socket->local().port;
}

int run(const std::vector<double>& numbers) {
  const auto port = free_port();
  if (!port) return 1;
  link::LinkParams link;
  link.delay = milliseconds(10);
  link.blackouts = {{Instant{} + from_seconds(numbers[1]), from_seconds(numbers[2]), {}}};
  const bench::RadioPorts ports{.listen = *port, .onward = static_cast<std::uint16_t>(numbers[0])};
  auto radio = bench::RadioPath::open({&ports, 1}, bench::RadioChannel{{{link, {}}}, {}, 1});
  if (!radio) return 1;
  std::printf("%d\n", *port);
  std::fflush(stdout);
  const Instant start = transport::monotonic_now();
  for (Instant now = start; now < start + from_seconds(numbers[3]);) {
    transport::wait_readable({}, now + milliseconds(2));
    now = transport::monotonic_now();
    radio->serve(Instant{} + (now - start));
  }
  return 0;
}

}  // namespace
}  // namespace pitwall

int main(int argc, char** argv) {
  std::vector<double> numbers;
  for (int i = 1; i < argc; ++i) numbers.push_back(std::stod(argv[i]));
  return numbers.size() == 4 && pitwall::testing::use_test_clock() ? pitwall::run(numbers) : 2;
}

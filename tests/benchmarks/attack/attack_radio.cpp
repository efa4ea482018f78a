// SPDX-License-Identifier: Apache-2.0
// An honest radio: attack_radio BASE_PORT DELAY_MS [COPY_PORT]. Carries every datagram between a
// car and a base, unread, the delay later; with COPY_PORT a copy of each goes there at once
// (tap.hpp). What comes from the base goes to where the car's newest datagram came from. Ends when
// its input does. All of it on loopback. Prints, with times of the monotonic clock in ns:
//   port PORT TIME   where the car sends to
//   car PORT TIME    a car speaks from a port that is not that of the datagram before
#include <unistd.h>

#include <array>
#include <cstdio>
#include <deque>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "protocol/transport/clock.hpp"
#include "protocol/transport/readiness.hpp"
#include "protocol/transport/udp_socket.hpp"
#include "tests/benchmarks/attack/tap.hpp"

namespace pitwall::attack {
namespace {

using transport::UdpDatagram;
using transport::UdpSocket;

constexpr Duration kIdle = milliseconds(100);

void say(const char* what, std::uint16_t port, Instant at) {
  std::printf("%s %d %lld\n", what, port, static_cast<long long>(at.ns));
  std::fflush(stdout);
}

class Radio {
 public:
  Radio(UdpSocket to_car, UdpSocket to_base, std::uint16_t base, Duration delay,
        std::optional<std::uint16_t> copies)
      : to_car_(std::move(to_car)),
        to_base_(std::move(to_base)),
        base_(base),
        delay_(delay),
        copies_(copies) {}

  void run() {
    say("port", to_car_.local().port, transport::monotonic_now());
    for (;;) {
      const Instant idle = transport::monotonic_now() + kIdle;
      const std::array<int, 3> watched{to_car_.fd(), to_base_.fd(), STDIN_FILENO};
      const Instant due = waiting_.empty() ? idle : std::min(idle, waiting_.front().due);
      const std::uint32_t ready = transport::wait_readable(watched, due);
      if ((ready & 4U) != 0) return;
      pick_up(to_car_, true);
      pick_up(to_base_, false);
      deliver();
    }
  }

 private:
  struct Waiting {
    Instant due;
    bool from_car;
    std::vector<std::uint8_t> bytes;
  };

  void pick_up(UdpSocket& socket, bool from_car) {
    const std::size_t n = socket.receive(batch_);
    for (const UdpDatagram& datagram : std::span(batch_).first(n)) {
      if (from_car && car_ != datagram.from) say("car", datagram.from.port, datagram.at);
      if (from_car) car_ = datagram.from;
      copy(from_car, datagram);
      const auto bytes = datagram.payload();
      waiting_.push_back({transport::monotonic_now() + delay_, from_car,
                          std::vector<std::uint8_t>(bytes.begin(), bytes.end())});
    }
  }

  void copy(bool from_car, const UdpDatagram& datagram) {
    if (!copies_) return;
    write_copy({from_car, datagram.from, datagram.payload()}, copied_);
    to_base_.send_to({.port = *copies_}, copied_);
  }

  void deliver() {
    const Instant now = transport::monotonic_now();
    for (; !waiting_.empty() && waiting_.front().due <= now; waiting_.pop_front()) {
      const Waiting& one = waiting_.front();
      if (one.from_car) to_base_.send_to({.port = base_}, one.bytes);
      if (!one.from_car && car_) to_car_.send_to(*car_, one.bytes);
    }
  }

  UdpSocket to_car_, to_base_;
  std::uint16_t base_;
  Duration delay_;
  std::optional<std::uint16_t> copies_;
  std::optional<UdpAddress> car_;
  std::deque<Waiting> waiting_;
  std::vector<UdpDatagram> batch_ = std::vector<UdpDatagram>(UdpSocket::kBatch);
  std::vector<std::uint8_t> copied_;
};

int run(const std::vector<std::string>& words) {
  auto to_car = UdpSocket::bind({});
  auto to_base = UdpSocket::bind({});
  if (!to_car || !to_base) {
    std::fprintf(stderr, "%s\n", to_string((to_car ? to_base : to_car).error()).c_str());
    return 1;
  }
  std::optional<std::uint16_t> copies;
  if (words.size() == 3) copies = static_cast<std::uint16_t>(std::stoul(words[2]));
  Radio(*std::move(to_car), *std::move(to_base), static_cast<std::uint16_t>(std::stoul(words[0])),
        from_seconds(std::stod(words[1]) * 1e-3), copies)
      .run();
  return 0;
}

}  // namespace
}  // namespace pitwall::attack

int main(int argc, char** argv) {
  const std::vector<std::string> words(argv + 1, argv + argc);
  return words.size() < 2 || words.size() > 3 ? 2 : pitwall::attack::run(words);
}

// SPDX-License-Identifier: Apache-2.0
// An attacker beside the radio path of a car and its base: attacker BASE_PORT. It receives a copy
// of every datagram (tap.hpp) and sends from thirty sockets of its own on fifteen addresses; it
// holds no key and stops nothing on its way. Only on loopback, each attack at most kLongest and
// kMostSent. Ends when its input does. Prints `port PORT`, where copies go; then, with times of the
// monotonic clock in ns, for each attack `begun TIME` with its first datagram and, when it is over,
// `ended SENT BYTES ANSWERS ANSWER_BYTES`: what it sent, and what was sent to it meanwhile.
//   known                         prints `known OPENINGS DATAGRAMS`
//   mark                          what was recorded until now is old
//   openings COUNT RATE SOURCES   the newest recorded openings, to the base, again and again
//   forged TARGET RATE SOURCES    forgery.hpp; TARGET: base, car or both
//   capture RATE SOURCES          everything recorded, each to its receiver, again and again
//   old RATE SOURCES              likewise of what is old
//   copies DELAY_US               every datagram that passes, so much later
//   relay DELAY_MS FOR_MS         likewise both ways, with what is sent to it; then silence
//   stop                          ends the attack
#include <unistd.h>

#include <array>
#include <cstdio>
#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "protocol/transport/clock.hpp"
#include "protocol/transport/readiness.hpp"
#include "tests/benchmarks/attack/forgery.hpp"
#include "tests/benchmarks/attack/recording.hpp"
#include "tests/benchmarks/attack/tap.hpp"

namespace pitwall::attack {
namespace {

using transport::UdpDatagram;
using transport::UdpSocket;

constexpr std::uint32_t kFirstIp = kLoopbackIp + 1;  // 127.0.0.2
constexpr std::uint32_t kIps = 15, kPorts = 2;
constexpr std::size_t kSockets = kIps * kPorts;
constexpr Duration kTurn = milliseconds(1), kIdle = milliseconds(50), kLongest = seconds(120);
constexpr std::uint64_t kMostSent = 6'000'000, kMostAtOnce = 2'000, kMostBehind_ms = 100;
constexpr std::size_t kToBase = 0, kToCar = 1;  // sockets of a relay

struct Traffic {
  std::uint64_t datagrams = 0, bytes = 0;

  void add(std::size_t size) {
    ++datagrams;
    bytes += size;
  }
};

struct Shot {
  const Bytes* bytes = nullptr;  // until the next one; none: nothing to send
  bool to_base = true;
};

class Attacker {
 public:
  Attacker(UdpSocket tap, std::vector<UdpSocket> sockets, std::uint16_t base)
      : tap_(std::move(tap)), sockets_(std::move(sockets)), base_{.port = base} {
    watched_ = {STDIN_FILENO, tap_.fd()};
    for (const UdpSocket& socket : sockets_) watched_.push_back(socket.fd());
  }

  void run() {
    std::printf("port %d\n", tap_.local().port);
    std::fflush(stdout);
    for (;;) {
      const std::uint32_t ready = transport::wait_readable(watched_, wake());
      if ((ready & 1U) != 0 && !execute()) return;
      if ((ready & 2U) != 0) observe();
      for (std::size_t i = 0; i < sockets_.size(); ++i)
        if ((ready >> (2 + i) & 1U) != 0) take_answers(i);
      pass_on();
      shoot();
      if (over()) end();
    }
  }

 private:
  struct Late {
    Instant due;
    bool to_base;
    Bytes bytes;
  };

  Instant wake() const {
    const Instant now = transport::monotonic_now();
    if (next_) return now + kTurn;
    return late_.empty() ? now + kIdle : std::min(now + kIdle, late_.front().due);
  }

  // ---- what passes, and what comes here

  void observe() {
    const std::size_t n = tap_.receive(batch_);
    for (const UdpDatagram& datagram : std::span(batch_).first(n)) {
      const auto copy = read_copy(datagram.payload());
      if (!copy) continue;
      recording_.add(*copy);
      if (copy->from_car) car_ = copy->sender;
      if (delay_) put_late(copy->from_car, copy->bytes, datagram.at + *delay_);
    }
  }

  void take_answers(std::size_t socket) {
    const std::size_t n = sockets_[socket].receive(batch_);
    for (const UdpDatagram& datagram : std::span(batch_).first(n)) {
      answers_.add(datagram.length);
      if (relays_) put_late(socket == kToCar, datagram.payload(), datagram.at + *delay_);
    }
  }

  void put_late(bool to_base, std::span<const std::uint8_t> bytes, Instant due) {
    late_.push_back({due, to_base, Bytes(bytes.begin(), bytes.end())});
  }

  void pass_on() {
    const Instant now = transport::monotonic_now();
    for (; !late_.empty() && late_.front().due <= now; late_.pop_front())
      send(late_.front().to_base ? kToBase : kToCar, late_.front().bytes, late_.front().to_base);
  }

  // ---- attacks that keep a rate

  void shoot() {
    if (!next_) return;
    const Instant now = transport::monotonic_now();
    auto due = static_cast<std::uint64_t>((now - since_).seconds() * rate_);
    if (due <= shots_) return;
    // What a busy machine kept us from sending is not made up for in one burst.
    const std::uint64_t behind = 1 + static_cast<std::uint64_t>(rate_) * kMostBehind_ms / 1'000;
    if (due - shots_ > behind) shots_ = due - behind;
    for (due = std::min(due, shots_ + kMostAtOnce); shots_ < due; ++shots_) {
      const Shot shot = next_();
      if (shot.bytes != nullptr) send(shots_ % sources_, *shot.bytes, shot.to_base);
    }
  }

  void send(std::size_t socket, const Bytes& bytes, bool to_base) {
    if (!to_base && !car_) return;
    if (sent_.datagrams == 0) {
      std::printf("begun %lld\n", static_cast<long long>(transport::monotonic_now().ns));
      std::fflush(stdout);
    }
    if (sockets_[socket].send_to(to_base ? base_ : *car_, bytes)) sent_.add(bytes.size());
  }

  bool over() const {
    if (!next_ && !delay_) return false;
    return sent_.datagrams >= kMostSent || transport::monotonic_now() >= until_;
  }

  void begin(Duration longest = kLongest) {
    end();
    since_ = transport::monotonic_now();
    until_ = since_ + longest;
    under_way_ = true;
  }

  void end() {
    next_ = {};
    delay_.reset();
    relays_ = false;
    late_.clear();
    if (under_way_) {
      const auto number = [](std::uint64_t n) { return static_cast<unsigned long long>(n); };
      std::printf("ended %llu %llu %llu %llu\n", number(sent_.datagrams), number(sent_.bytes),
                  number(answers_.datagrams), number(answers_.bytes));
      std::fflush(stdout);
    }
    under_way_ = false;
    sent_ = answers_ = {};
    shots_ = 0;
  }

  // ---- words

  // False at the end of the input.
  bool execute() {
    std::array<std::uint8_t, 512> bytes{};
    const transport::ReadOutcome read = transport::read_available(STDIN_FILENO, bytes);
    received_.append(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(read.bytes));
    for (std::size_t end = 0; (end = received_.find('\n')) != std::string::npos;
         received_.erase(0, end + 1)) {
      std::istringstream words(received_.substr(0, end));
      if (!execute(words)) std::fprintf(stderr, "what is: %s\n", words.str().c_str());
    }
    return !read.ended;
  }

  bool execute(std::istringstream& words) {
    static const std::map<std::string, bool (Attacker::*)(std::istringstream&)> kWords{
        {"openings", &Attacker::openings}, {"forged", &Attacker::forged},
        {"capture", &Attacker::capture},   {"old", &Attacker::old},
        {"copies", &Attacker::copies},     {"relay", &Attacker::relay}};
    std::string word;
    words >> word;
    if (word == "mark") return recording_.mark(), true;
    if (word == "stop") return end(), true;
    if (word == "known") {
      std::printf("known %zu %zu\n", recording_.openings().size(), recording_.capture().size());
      std::fflush(stdout);
      return true;
    }
    const auto known = kWords.find(word);
    return known != kWords.end() && (this->*known->second)(words);
  }

  bool pace(std::istringstream& words) {
    words >> rate_ >> sources_;
    if (words.fail() || !(rate_ > 0) || sources_ < 1 || sources_ > kSockets) return false;
    begin();
    return true;
  }

  bool openings(std::istringstream& words) {
    std::size_t count = 0;
    if (!(words >> count) || !pace(words)) return false;
    const auto newest = recording_.openings(count);
    chosen_.assign(newest.begin(), newest.end());
    next_ = [this] { return chosen_.empty() ? Shot{} : Shot{&chosen_[shots_ % chosen_.size()]}; };
    return true;
  }

  bool forged(std::istringstream& words) {
    std::string target;
    if (!(words >> target) || !pace(words)) return false;
    next_ = [this, target] {
      const bool to_base = target == "base" || (target == "both" && shots_ % 2 == 0);
      return Shot{&forger_.next(recording_.capture(), to_base), to_base};
    };
    return target == "base" || target == "car" || target == "both";
  }

  bool capture(std::istringstream& words) {
    return again(words, [this] { return recording_.capture(); });
  }
  bool old(std::istringstream& words) {
    return again(words, [this] { return recording_.before_mark(); });
  }
  bool again(std::istringstream& words, const std::function<std::span<const Recorded>()>& what) {
    if (!pace(words)) return false;
    const std::size_t length = what().size();
    next_ = [this, what, length] {
      if (length == 0) return Shot{};
      const Recorded& one = what()[shots_ % length];
      return Shot{&one.bytes, one.from_car};
    };
    return true;
  }

  bool copies(std::istringstream& words) {
    double delay_us = 0;
    if (!(words >> delay_us)) return false;
    begin();
    delay_ = from_seconds(delay_us * 1e-6);
    return true;
  }
  bool relay(std::istringstream& words) {
    double delay_ms = 0, length_ms = 0;
    if (!(words >> delay_ms >> length_ms)) return false;
    begin(from_seconds(length_ms * 1e-3));
    delay_ = from_seconds(delay_ms * 1e-3);
    relays_ = true;
    return true;
  }

  UdpSocket tap_;
  std::vector<UdpSocket> sockets_;
  std::vector<int> watched_;
  UdpAddress base_;
  std::optional<UdpAddress> car_;
  std::vector<UdpDatagram> batch_ = std::vector<UdpDatagram>(UdpSocket::kBatch);
  std::string received_;
  Recording recording_;
  PacketForger forger_{1};

  std::function<Shot()> next_;  // of an attack that keeps a rate
  std::vector<Bytes> chosen_;
  double rate_ = 0;
  std::size_t sources_ = 1;
  std::uint64_t shots_ = 0;
  std::optional<Duration> delay_;  // of an attack that follows what passes
  bool relays_ = false;
  std::deque<Late> late_;
  bool under_way_ = false;
  Instant since_{}, until_{};
  Traffic sent_, answers_;
};

int run(std::uint16_t base) {
  std::vector<UdpSocket> sockets;
  for (std::size_t i = 0; i < kSockets; ++i) {
    auto socket = UdpSocket::bind({.ip = kFirstIp + static_cast<std::uint32_t>(i) % kIps});
    if (!socket) return std::fprintf(stderr, "%s\n", to_string(socket.error()).c_str()), 1;
    sockets.push_back(*std::move(socket));
  }
  auto tap = UdpSocket::bind({});
  if (!tap) return std::fprintf(stderr, "%s\n", to_string(tap.error()).c_str()), 1;
  Attacker(*std::move(tap), std::move(sockets), base).run();
  return 0;
}

}  // namespace
}  // namespace pitwall::attack

int main(int argc, char** argv) {
  return argc == 2 ? pitwall::attack::run(static_cast<std::uint16_t>(std::stoul(argv[1]))) : 2;
}

// SPDX-License-Identifier: Apache-2.0
// A car and a base whose datagrams the input delivers, drops, changes, repeats, reflects and
// restarts at will: whatever is opened was sealed by the other end for this session and comes once;
// no reply is longer than what it replies to; at the end the two find each other again.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <set>
#include <span>
#include <vector>

#include "protocol/telemetry/session/association.hpp"
#include "protocol/vocabulary/check.hpp"

namespace {

using namespace pitwall;
using namespace pitwall::telemetry;

using Datagram = std::vector<std::uint8_t>;

constexpr UdpAddress kCarAt{.ip = 1, .port = 1}, kBaseAt{.ip = 2, .port = 2},
    kElsewhere{.ip = 9, .port = 9};
constexpr std::size_t kMaxAir = 64, kMaxSteps = 2'000;

struct Input {
  std::span<const std::uint8_t> bytes;

  std::uint8_t next() {
    if (bytes.empty()) return 0;
    const std::uint8_t byte = bytes.front();
    bytes = bytes.subspan(1);
    return byte;
  }
};

// One run of one end; a restart makes another one.
struct Run {
  SeededRandomness randomness;
  Association association;
  std::uint64_t boot;
  std::set<std::pair<std::uint64_t, std::uint64_t>> opened;  // session, number

  Run(const KeyFile& keys, std::uint64_t run_boot)
      : randomness(run_boot),
        association({.keys = keys,
                     .greeting = {.boot = run_boot},
                     .peer = {keys.role == Role::kCar ? kBaseAt : UdpAddress{},
                              keys.role == Role::kCar ? kBaseAt : UdpAddress{}},
                     .paths = kPaths},
                    randomness),
        boot(run_boot) {}
};

struct Sent {
  Datagram datagram;
  bool to_base;
};

class World {
 public:
  explicit World(Input input) : input_(input) {
    SeededRandomness randomness(1);
    const Identity car = make_identity(randomness), base = make_identity(randomness);
    keys_ = {KeyFile{.role = Role::kCar, .own = car, .peer = base.public_key},
             KeyFile{.role = Role::kBase, .own = base, .peer = car.public_key}};
    restart(0);
    restart(1);
  }

  void play() {
    for (std::size_t i = 0; i < kMaxSteps && !input_.bytes.empty(); ++i) step();
  }
  // Over a link that works, whatever was before.
  void find_each_other() {
    now_ += seconds(20);
    for (int slot = 0; slot < 40; ++slot) {
      air_.clear();
      for (const std::size_t end : {0U, 1U}) say(end);
      const std::vector<Sent> sent = air_;
      for (const Sent& s : sent) deliver(s.datagram, s.to_base, 0, s.to_base ? kCarAt : kBaseAt);
      now_ += milliseconds(20);
    }
    CHECK(ends_[0]->association.ready() && ends_[1]->association.ready());
    const std::size_t before = ends_[0]->opened.size() + ends_[1]->opened.size();
    air_.clear();
    for (const std::size_t end : {0U, 1U}) say(end);
    const std::vector<Sent> sent = air_;
    for (const Sent& s : sent) deliver(s.datagram, s.to_base, 0, s.to_base ? kCarAt : kBaseAt);
    CHECK(ends_[0]->opened.size() + ends_[1]->opened.size() >= before + 2);
  }

 private:
  void step() {
    const std::uint8_t what = input_.next();
    switch (what % 8) {
      case 0:
      case 1:
        return say(what % 2);
      case 2:
        now_ += milliseconds(input_.next() * 50);
        return;
      case 3:
        return restart(input_.next() % 2);
      case 4:
        return raw();
      default:
        return from_the_air(what % 8 == 6);
    }
  }

  void restart(std::size_t end) { ends_[end] = std::make_unique<Run>(keys_[end], ++boots_); }

  // Everything that is due, and one packet.
  void say(std::size_t end) {
    Run& run = *ends_[end];
    std::array<std::uint8_t, kMaxDatagram> out{};
    for (PathId path = 0; path < kPaths; ++path) {
      if (const auto due = run.association.poll(path, now_, out)) put(due->bytes, end == 0);
    }
    ++contents_;
    Datagram body(8 + contents_ % 50);
    for (std::size_t i = 0; i < 8; ++i) body[i] = static_cast<std::uint8_t>(contents_ >> 8 * i);
    if (const auto sealed = run.association.seal(body, now_, out)) {
      sealed_[run.boot].insert(body);
      put(sealed->datagram, end == 0);
    }
  }

  void put(std::span<const std::uint8_t> bytes, bool to_base) {
    if (air_.size() < kMaxAir) air_.push_back({{bytes.begin(), bytes.end()}, to_base});
  }

  void from_the_air(bool change) {
    if (air_.empty()) return;
    const std::uint8_t how = input_.next();
    const std::size_t which = input_.next() % air_.size();
    Sent sent = air_[which];
    if (change) {
      const std::size_t at = input_.next() % sent.datagram.size();
      sent.datagram[at] = static_cast<std::uint8_t>(sent.datagram[at] ^ input_.next());
      sent.datagram.resize(std::max<std::size_t>(1, sent.datagram.size() - how / 64 * 7));
    }
    if ((how & 1U) == 0) air_.erase(air_.begin() + static_cast<std::ptrdiff_t>(which));
    const bool to_base = (how & 2U) == 0 ? sent.to_base : !sent.to_base;
    const UdpAddress home = sent.to_base ? kCarAt : kBaseAt;
    deliver(sent.datagram, to_base, (how & 4U) == 0 ? 0 : 1, (how & 8U) == 0 ? home : kElsewhere);
  }

  void raw() {
    Datagram datagram(input_.next());
    for (std::uint8_t& byte : datagram) byte = input_.next();
    deliver(datagram, input_.next() % 2 == 0, 0, kElsewhere);
  }

  void deliver(const Datagram& datagram, bool to_base, PathId path, UdpAddress from) {
    Run& run = *ends_[to_base ? 1 : 0];
    std::array<std::uint8_t, kMaxBody> plain{};
    if (const auto opened = run.association.feed(datagram, path, from, now_, plain)) {
      CHECK(run.opened.insert({opened->session, opened->sequence}).second);
      const std::uint64_t peer = run.association.peer()->boot;
      CHECK(sealed_[peer].contains({opened->body.begin(), opened->body.end()}));
    }
    if (!to_base) return;
    CHECK(run.association.poll_size(path, now_) <= std::max(datagram.size(), kOpeningSize));
    if (datagram.size() < kUnknownSize && run.association.poll_size(path, now_) > 0) {
      CHECK(waiting_);  // a reply to an earlier one
    }
    waiting_ = run.association.poll_size(path, now_) > 0 || waiting_;
  }

  Input input_;
  std::array<KeyFile, 2> keys_;
  std::array<std::unique_ptr<Run>, 2> ends_;
  std::map<std::uint64_t, std::set<Datagram>> sealed_;  // bodies by the run that sealed them
  std::vector<Sent> air_;
  std::uint64_t boots_ = 0, contents_ = 0;
  bool waiting_ = false;
  Instant now_{seconds(10).ns};
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  World world(Input{{bytes, size}});
  world.play();
  world.find_each_other();
  return 0;
}

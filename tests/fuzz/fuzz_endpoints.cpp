// Both ends of the radio under a network that the fuzzer drives: what is delivered when, twice,
// late, spoiled, from elsewhere, or never; restarts and long silences in between. Aborts where the
// car applies a command twice or late, where its stop opens by itself, or where the base shows what
// the car never had or says it is younger than it is.
// SPDX-License-Identifier: Apache-2.0
#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "protocol/vocabulary/check.hpp"
#include "tests/benchmarks/radio/virtual_radio.hpp"

namespace {

using namespace pitwall;             // NOLINT: a program of one file
using namespace pitwall::telemetry;  // NOLINT
using pitwall::radio::VirtualRadio;

constexpr std::size_t kUnderWay = 64;
constexpr HolderId kOperator = 1;
constexpr UdpAddress kElsewhere{0x0A000063, 9'999};

class Adversary {
 public:
  Adversary(std::span<const std::uint8_t> script, const radio::RadioSetup& setup)
      : script_(script), radio_(setup) {
    radio_.tap([this](bool down, PathId path, std::span<const std::uint8_t> bytes) {
      auto& queue = under_way_[down ? 0 : 1][path];
      if (queue.size() == kUnderWay) queue.pop_front();
      queue.emplace_back(bytes.begin(), bytes.end());
      return false;  // the emulator has nothing to do
    });
  }

  void run() {
    while (at_ < script_.size()) {
      act(byte() % 17);
      look();
    }
  }

 private:
  using Bytes = std::vector<std::uint8_t>;

  std::uint8_t byte() { return at_ < script_.size() ? script_[at_++] : std::uint8_t{0}; }

  void act(unsigned what) {
    switch (what) {
      case 0:
      case 1:
        return steps(1 + byte() % 32);
      case 2:
      case 3:
      case 4:
        return deliver_all();
      case 5:
        return deliver(true);
      case 6:
        return deliver(false);
      case 7:
        return spoil();
      case 8:
        return clear();
      case 9:
        return restart(byte());
      case 10:
        return jump();
      case 11:
        return command();
      case 12:
        return stop(byte());
      case 13:
        return release();
      case 14:
        return splice();
      case 15:
        return move(byte());
      default:
        return from_elsewhere();
    }
  }

  void steps(unsigned count) {
    for (unsigned i = 0; i < count; ++i) {
      radio_.step();
      look();
    }
  }
  // As a good link would: the way that most scripts must go to get anywhere.
  void deliver_all() {
    for (unsigned i = 0; i < 8; ++i) {
      steps(5);
      for (bool down : {true, false}) {
        for (PathId path = 0; path < kPaths; ++path) {
          auto& queue = queue_of(down, path);
          for (; !queue.empty(); queue.pop_front()) give(down, path, queue.front());
        }
      }
    }
  }
  std::deque<Bytes>& queue_of(bool down, PathId path) { return under_way_[down ? 0 : 1][path]; }
  struct Pick {
    bool down;
    PathId path;
    std::size_t index;
  };
  std::optional<Pick> pick() {
    const std::uint8_t dice = byte();
    const Pick pick{(dice & 1U) != 0, static_cast<PathId>(dice >> 1 & 1U), std::size_t{dice} >> 2U};
    const std::size_t size = queue_of(pick.down, pick.path).size();
    if (size == 0) return {};
    return Pick{pick.down, pick.path, pick.index % size};
  }
  void give(bool down, PathId path, const Bytes& bytes) {
    const Bytes copy = bytes;  // its answer may change the queue
    radio_.inject(down, path, down ? radio_.car_address(path) : radio_.base_address(path), copy);
    look();
  }
  void deliver(bool remove) {
    const auto one = pick();
    if (!one) return;
    auto& queue = queue_of(one->down, one->path);
    const Bytes bytes = queue[one->index];
    if (remove) queue.erase(queue.begin() + static_cast<std::ptrdiff_t>(one->index));
    give(one->down, one->path, bytes);
  }
  void spoil() {
    const auto one = pick();
    if (!one) return;
    Bytes bytes = queue_of(one->down, one->path)[one->index];
    const std::size_t place = byte() * 5U % bytes.size();
    bytes[place] ^= static_cast<std::uint8_t>(byte() | 1U);
    if ((byte() & 3U) == 0) bytes.resize(place);
    give(one->down, one->path, bytes);
  }
  void splice() {
    const auto one = pick();
    const auto other = pick();
    if (!one || !other) return;
    Bytes bytes = queue_of(one->down, one->path)[one->index];
    const Bytes& tail = queue_of(other->down, other->path)[other->index];
    const std::size_t cut = byte() % (bytes.size() + 1);
    bytes.resize(cut);
    if (cut < tail.size())
      bytes.insert(bytes.end(), tail.begin() + static_cast<std::ptrdiff_t>(cut), tail.end());
    give(one->down, other->path, bytes);
  }
  void from_elsewhere() {
    const auto one = pick();
    if (!one) return;
    radio_.inject(one->down, one->path, kElsewhere,
                  Bytes(queue_of(one->down, one->path)[one->index]));
    look();
  }
  void clear() {
    for (auto& way : under_way_) way[byte() & 1U].clear();
  }
  void restart(std::uint8_t who) {
    if ((who & 1U) != 0) {
      radio_.restart_base();
      ++base_run_;
    } else {
      radio_.restart_car();
      latched_ = false;  // a new process: it latches again with the first packet
      released_.clear();
    }
  }
  // One end of one path is seen from another address, or from its first one again.
  void move(std::uint8_t which) {
    const auto path = static_cast<PathId>(which >> 1U & 1U);
    const bool base = (which & 1U) != 0;
    const UdpAddress home = base ? base_home_[path] : car_home_[path];
    const UdpAddress there{home.ip + (which >> 2U & 3U), home.port};
    base ? radio_.move_base(path, there) : radio_.move_car(path, there);
  }
  void jump() {
    steps(1);
    radio_.pause(milliseconds(byte() * 40));
    look();
  }

  void command() {
    auto& station = radio_.station();
    if (!station.authority().renew(kOperator, radio_.base_now())) {
      station.authority().take(kOperator, radio_.base_now());
    }
    const auto type = static_cast<CommandType>(byte() % kCommandTypes);
    if (type == CommandType::kReleaseStop) return;
    const auto id = station.issue({type, row_of(type).min, kOperator}, radio_.base_now());
    if (id) issued_[{base_run_, *id}] = radio_.now();
  }
  void stop(std::uint8_t level) {
    radio_.station().stop().demand(
        (level & 1U) != 0 ? StopLevel::kEmergency : StopLevel::kControlled, StopReason::kOperator);
  }
  void release() {
    const OperatorView view = radio_.car().view(radio_.car_now());
    radio_.car().standstill(true);
    radio_.station().authority().take(kOperator, radio_.base_now());
    const auto id = radio_.station().issue(
        {CommandType::kReleaseStop, static_cast<double>(view.stop_challenge), kOperator},
        radio_.base_now());
    if (id) released_.insert(view.stop_challenge);
  }

  void look() {
    consume();
    const OperatorView view = radio_.car().view(radio_.car_now());
    const bool latched = view.stop != StopLevel::kNone;
    if (latched_ && !latched) CHECK(released_.count(challenge_) == 1);
    if (latched) challenge_ = view.stop_challenge;
    latched_ = latched;
    CHECK(radio_.content_errors().all() == 0);
  }
  // The base that gave it may have died since, so it is looked for in all runs of the base.
  void consume() {
    while (const auto due = radio_.car().next_command(radio_.car_now())) {
      bool known = false;
      for (std::uint64_t run = 0; run <= base_run_ && !known; ++run) {
        const auto it = issued_.find({run, due->number});
        if (it == issued_.end()) continue;
        if (radio_.now() - it->second > row_of(due->command.type).time_to_live) continue;
        known = true;
        issued_.erase(it);  // a second time it is not known
      }
      CHECK(known);
      radio_.car().decide(due->id, Outcome::kApplied, radio_.car_now());
    }
  }

  std::span<const std::uint8_t> script_;
  std::size_t at_ = 0;
  std::array<std::array<std::deque<Bytes>, kPaths>, 2> under_way_;
  VirtualRadio radio_;
  std::array<UdpAddress, kPaths> car_home_{radio_.car_address(0), radio_.car_address(1)},
      base_home_{radio_.base_address(0), radio_.base_address(1)};
  std::map<std::pair<std::uint64_t, CommandId>, Instant> issued_;
  std::set<std::uint16_t> released_;
  std::uint64_t base_run_ = 0;
  bool latched_ = false;
  std::uint16_t challenge_ = 0;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 2) return 0;
  radio::RadioSetup setup;
  setup.paths = (data[0] & 1U) != 0 ? 2 : 1;
  setup.policy = (data[0] & 2U) != 0 ? PathPolicy::kBest : PathPolicy::kDuplicate;
  setup.signed_only = (data[0] & 4U) != 0;
  setup.clock_offset = seconds(data[1]);
  Adversary({data + 2, size - 2}, setup).run();
  return 0;
}

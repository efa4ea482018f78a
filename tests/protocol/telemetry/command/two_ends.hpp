// Simulation of both ends of commands, stops and authority over a bad radio: real packet bodies,
// fifty a second each way, over one or two radios that lose, delay, duplicate and reorder them.
//   units  virtual time of the base's clock; the car's clock is kCarAhead ahead of it
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <queue>
#include <random>
#include <set>
#include <vector>

#include "protocol/telemetry/command/authority.hpp"
#include "protocol/telemetry/command/command_ledger.hpp"
#include "protocol/telemetry/command/command_transmitter.hpp"
#include "protocol/telemetry/command/joystick.hpp"
#include "protocol/telemetry/command/stop_latch.hpp"
#include "protocol/telemetry/packet/body.hpp"
#include "tests/support/draw.hpp"

namespace pitwall::telemetry::testing {

using pitwall::testing::draw_exponential;
using pitwall::testing::draw_uniform;

inline constexpr Duration kSlotTime = milliseconds(20), kTickTime = milliseconds(1);
inline constexpr Duration kCarAhead = seconds(777'777);
inline constexpr HolderId kOperator = 7;

// Loss of one radio in one direction: independent packets, or fades with a mean length.
struct Fading {
  double loss = 0.0;          // long-run share
  Duration mean_fade{};       // zero: each packet is lost independently
  double loss_between = 0.0;  // outside fades
};

struct ChannelParams {
  Fading fading{};
  int radios = 1;
  Duration delay_min = milliseconds(20), delay_max = milliseconds(20);
  double twice = 0.0;
  Duration clock_bound{};  // error bound of the clock: a packet seems up to this much older
  std::uint32_t seed = 1;
};

// A random duration between zero and `most`.
inline Duration some_of(Duration most, std::mt19937_64& random) {
  return from_seconds(draw_uniform(random, 0.0, most.seconds()));
}

class Radio {
 public:
  Radio(const Fading& fading, std::uint32_t seed) : fading_(fading), random_(seed) {}

  bool loses(Instant now) {
    if (fading_.mean_fade.ns == 0) return chance(fading_.loss);
    const double share = (fading_.loss - fading_.loss_between) / (1.0 - fading_.loss_between);
    while (until_ <= now) {
      fades_ = !fades_;
      const double mean_s = fades_ ? fading_.mean_fade.seconds()
                                   : fading_.mean_fade.seconds() * (1.0 - share) / share;
      until_ += from_seconds(draw_exponential(random_, mean_s));
    }
    return fades_ || chance(fading_.loss_between);
  }

 private:
  bool chance(double p) { return draw_uniform(random_) < p; }

  Fading fading_;
  std::mt19937_64 random_;
  bool fades_ = false;
  Instant until_{};
};

struct Flight {
  Instant arrives, sent;
  std::uint64_t sequence = 0;
  std::vector<std::uint8_t> bytes;
};

// One direction with all its radios. The first copy of a packet to arrive counts.
class Way {
 public:
  Way(const ChannelParams& params, std::uint32_t salt)
      : params_(params), random_(params.seed + salt) {
    for (int i = 0; i < params.radios; ++i) {
      radios_.emplace_back(params.fading, params.seed + salt + 101U * static_cast<unsigned>(i + 1));
    }
  }

  void send(std::span<const std::uint8_t> bytes, Instant now) {
    ++sequence_;
    for (Radio& radio : radios_) {
      const bool lost = radio.loses(now);
      const int copies = draw_uniform(random_) < params_.twice ? 2 : 1;
      for (int i = 0; i < copies && !lost && !cut; ++i) {
        const Duration delay =
            params_.delay_min + some_of(params_.delay_max - params_.delay_min, random_);
        flying_.push({now + delay, now, sequence_, {bytes.begin(), bytes.end()}});
      }
    }
  }
  // `once`: drops duplicates as the session's replay window does; otherwise they are delivered too.
  template <class Take>
  void arrive(Instant now, bool once, Take&& take) {
    while (!flying_.empty() && flying_.top().arrives <= now) {
      const Flight flight = flying_.top();
      flying_.pop();
      if (seen_.insert(flight.sequence).second || !once) take(flight);
      if (seen_.size() > 4'096) seen_.erase(seen_.begin());
    }
  }

  bool cut = false;  // nothing gets through

 private:
  struct Later {
    bool operator()(const Flight& a, const Flight& b) const { return a.arrives > b.arrives; }
  };
  ChannelParams params_;
  std::mt19937_64 random_;
  std::vector<Radio> radios_;
  std::priority_queue<Flight, std::vector<Flight>, Later> flying_;
  std::set<std::uint64_t> seen_;
  std::uint64_t sequence_ = 0;
};

// Life of one command, as an outside observer sees it.
struct CommandHistory {
  Command command;
  Instant issued{};
  std::optional<Instant> known;  // first arrival at the car
  int applied = 0;
  std::optional<Instant> applied_at;
};

class TwoEnds {
 public:
  explicit TwoEnds(const ChannelParams& params)
      : channel(params), up(params, 17), down(params, 29), random_(params.seed) {
    authority.take(kOperator, now);
    transmitter.set_peer_boot(kCarBoot, now);
    ledger.set_peer_boot(kBaseBoot);
  }

  std::optional<CommandId> issue(CommandType type, double argument) {
    const Command command{type, argument, kOperator};
    const auto id = transmitter.issue(command, now);
    if (id) histories[*id] = {command, now, {}, 0, {}};
    return id;
  }

  void run(Duration span) {
    for (const Instant end = now + span; now < end; now += kTickTime) tick();
  }
  void tick() {
    if (now.ns % kAuthorityRenewal.ns == 0 && renews) authority.renew(kOperator, now);
    if (now.ns % kSlotTime.ns == 0) base_sends();
    if (now.ns % kSlotTime.ns == kSlotTime.ns / 2) car_sends();
    up.arrive(now, once, [&](const Flight& flight) { car_receives(flight); });
    down.arrive(now, once, [&](const Flight& flight) { base_receives(flight); });
    consume();
  }

  Instant car_now() const { return now + kCarAhead; }

  static constexpr std::uint64_t kBaseBoot = 0xB05E, kCarBoot = 0xCA5;
  ChannelParams channel;
  Way up, down;
  Instant now{};
  bool renews = true, once = true, clock_known = true, consumer_asks = true;
  bool stands = false;          // the car is at standstill
  bool releases = false;        // kReleaseStop is passed to the latch
  std::size_t room = kMaxBody;  // for the body of a packet

  CommandTransmitter transmitter{kBaseBoot};
  AuthorityRegister authority;
  StopTransmitter stop;
  JoystickSender stick;
  CommandLedger ledger{kCarBoot};
  AuthorityView view;
  StopLatch latch;
  JoystickReceiver joystick;
  std::map<CommandId, CommandHistory> histories;
  std::array<CommandId, kCommandTypes> newest_applied{};
  int out_of_order = 0;

 private:
  static constexpr std::array<Group, 3> kUpGroups{Group::kStop, Group::kJoystick,
                                                  Group::kAuthority};

  void base_sends() {
    Snapshot snapshot;
    put(stop.state(), snapshot.values);
    stick.put(snapshot.values, now);
    authority.put(snapshot.values, now);
    for (const Group group : kUpGroups) snapshot.at(group) = now;
    std::array<std::uint8_t, kMaxBody> buffer{};
    BodyWriter body(buffer, room, Direction::kUp);
    body.begin(now, 1);
    CodecCounters codec;
    body.add_groups(snapshot, kUpGroups, now, codec);
    transmitter.fill(body, now);
    up.send(body.bytes(), now);
  }
  void car_sends() {
    std::array<std::uint8_t, kMaxBody> buffer{};
    BodyWriter body(buffer, room, Direction::kDown);
    body.begin(car_now(), 1);
    ledger.fill(body, car_now());
    down.send(body.bytes(), now);
  }
  void car_receives(const Flight& flight) {
    const auto body = parse_body(flight.bytes, Direction::kUp);
    if (!body) return;
    Received received;
    received.at = car_now();
    received.sequence = flight.sequence;
    if (clock_known) {
      received.sent_earliest = flight.sent + kCarAhead - some_of(channel.clock_bound, random_);
    }
    view.receive(body->values, received);
    joystick.receive(body->values, received);
    if (const auto stated = stop_state_of(body->values)) latch.receive(*stated, car_now());
    for (const Record& record : body->records) {
      note_known(record);
      ledger.take(record, received, view);
    }
  }
  void base_receives(const Flight& flight) {
    const auto body = parse_body(flight.bytes, Direction::kDown);
    if (!body) return;
    Received received;
    received.at = now;
    for (const Record& record : body->records) transmitter.take(record, received);
  }
  void note_known(const Record& record) {
    const auto stated = parse_command(record.payload);
    if (record.type != RecordType::kCommand || !stated) return;
    const auto history = histories.find(stated->number);
    if (history != histories.end() && !history->second.known) history->second.known = now;
  }
  void consume() {
    while (const auto due = consumer_asks ? ledger.take_due(car_now(), view) : std::nullopt) {
      CommandHistory& history = histories[due->number];
      ++history.applied;
      history.applied_at = now;
      CommandId& newest = newest_applied[static_cast<std::size_t>(due->command.type)];
      if (due->number < newest) ++out_of_order;
      newest = std::max(newest, due->number);
      ledger.decide(due->id, answer(due->command), car_now());
    }
  }

  Outcome answer(const Command& command) {
    if (command.type != CommandType::kReleaseStop || !releases) return Outcome::kApplied;
    const auto challenge = static_cast<std::uint16_t>(command.argument);
    return latch.release(challenge, stands) ? Outcome::kApplied : Outcome::kRefused;
  }

  std::mt19937_64 random_;
};

// Outcome of the command at the base; nullopt before there is one.
inline std::optional<Outcome> outcome(const TwoEnds& rig, CommandId id) {
  const CommandProgress* progress = rig.transmitter.progress(id);
  return progress == nullptr ? std::nullopt : progress->outcome;
}

}  // namespace pitwall::telemetry::testing

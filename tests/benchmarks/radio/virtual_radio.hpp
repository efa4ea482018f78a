// Simulation of car and base with the radio between them, in virtual time: both endpoints, both
// directions of each path. For tests, long runs and benchmarks of the protocol.
//   in     link parameters by path and direction, budgets, seed; the events of the run
//   out    the endpoints, true ages at the base sampled each millisecond, every departure
//   invariants
//          one seed gives one run; time moves in steps of 1 ms. The car samples its state and polls
//          each kTick, as the vehicle's loop does; the base each step. A value depends on its field
//          and the millisecond of its sample (value_of()), so that arrivals are compared with it
//   time   now() is the true time of the radio; each end has its own clock
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "hil/link/link_emulator.hpp"
#include "protocol/telemetry/endpoint/car_endpoint.hpp"
#include "protocol/telemetry/endpoint/station_endpoint.hpp"
#include "tests/benchmarks/radio/age_meter.hpp"

namespace pitwall::radio {

inline constexpr Duration kStep = milliseconds(1), kTick = milliseconds(10);

// Seed of the emulator of this path and direction, to compute its fades beforehand.
constexpr std::uint64_t link_seed(std::uint64_t seed, telemetry::PathId path, bool down) {
  return seed * 4 + path * 2U + (down ? 0U : 1U);
}

struct RadioSetup {
  std::array<link::LinkParams, telemetry::kPaths> down{}, up{};
  std::array<telemetry::BudgetParams, telemetry::kPaths> budget_down{}, budget_up{};
  std::uint8_t paths = 1;
  telemetry::PathPolicy policy = telemetry::PathPolicy::kDuplicate;
  Duration clock_offset{};       // the base's clock minus the car's
  double clock_drift_ppm = 0.0;  // of the base's clock
  std::uint64_t seed = 1;
  std::uint64_t chance = 0;  // other than 0: another run with the same keys and links
  Duration tick_jitter{};    // each tick of the car is late by a random time of 0 .. this
  bool signed_only = false;
  std::uint64_t first_sequence = 1;
  bool stamps_kept = true;  // a restarted base keeps the newest opening stamp from before
  Duration to_utc{};        // UTC minus the car's clock
  std::array<UdpAddress, telemetry::kPaths> spare{};  // further base addresses of the car
  // Registries that the ends announce; nullptr: the real one. They outlive the radio.
  const telemetry::SchemaDescription* schema_of_car = nullptr;
  const telemetry::SchemaDescription* schema_of_base = nullptr;
};

// A datagram that left an end; the size includes IP and UDP.
struct Departure {
  Instant at{};
  std::size_t bytes = 0;
};

// False data at the base, counted against the true samples.
struct ContentErrors {
  std::uint64_t too_young = 0;      // the reported sample time is later than the true one
  std::uint64_t never_sampled = 0;  // a value that the car did not have in that sample
  std::uint64_t went_back = 0;      // an older sample after a newer one
  std::uint64_t repeated = 0;       // the same packet a second time

  std::uint64_t all() const { return too_young + never_sampled + went_back + repeated; }
};

class VirtualRadio {
 public:
  explicit VirtualRadio(const RadioSetup& setup);

  void step();
  void run(Duration length);
  Instant now() const { return now_; }
  Instant car_time(Instant air) const;
  Instant base_time(Instant air) const;
  Instant car_now() const { return car_time(now_); }
  Instant base_now() const { return base_time(now_); }

  telemetry::CarEndpoint& car() { return *car_; }
  telemetry::StationEndpoint& station() { return *station_; }
  telemetry::LinkReport car_report() const { return car_->report(car_now()); }
  telemetry::LinkReport base_report() const { return station_->report(base_now()); }
  link::LinkEmulator& down(telemetry::PathId path) { return *down_[path]; }
  link::LinkEmulator& up(telemetry::PathId path) { return *up_[path]; }

  // Replaces the end by a new process, which keeps only the keys and, at the base, the newest stamp
  // if stamps_kept. It starts after `away`; until then the end neither receives nor sends.
  void restart_car(Duration away = {});
  void restart_base(Duration away = {});
  // Takes effect at the car's next start.
  void set_clock_of_car(Duration to_utc) { setup_.to_utc = to_utc; }
  // Blocks (true) or unblocks (false) each direction of the path from now on.
  void cut(telemetry::PathId path, bool down, bool up);
  // The other end sees this source from now on (another port of a NAT); the old address is dead.
  void move_car(telemetry::PathId path, UdpAddress source);
  void move_base(telemetry::PathId path, UdpAddress source);
  // Called with each datagram before the link; if it returns false the datagram is dropped.
  using Tap = std::function<bool(bool down, telemetry::PathId, std::span<const std::uint8_t>)>;
  void tap(Tap tap) { tap_ = std::move(tap); }
  // Called with each datagram that arrives at an address without an end.
  using Stray = std::function<void(bool down, telemetry::PathId, std::uint16_t port,
                                   std::span<const std::uint8_t>)>;
  void listen(Stray stray) { stray_ = std::move(stray); }
  // Delivers a datagram of a third party at an end.
  void inject(bool at_base, telemetry::PathId path, UdpAddress from,
              std::span<const std::uint8_t> bytes);
  // Advances time without polls and arrivals, in whole ticks: a stopped process.
  void pause(Duration length) { now_ += kTick * (length / kTick); }
  UdpAddress car_address(telemetry::PathId path) const { return car_side_.address[path]; }
  UdpAddress base_address(telemetry::PathId path) const { return base_side_.address[path]; }
  // Groups that the car samples (default: all); other groups are never sent.
  void sample_only(telemetry::GroupSet groups) { sampled_ = groups; }

  const AgeMeter& ages() const { return ages_; }
  void reset_ages() { ages_.reset(); }
  // True time of the group's newest sample at the base; nullopt before the first one.
  std::optional<Instant> sample_at_base(telemetry::Group group) const;
  const ContentErrors& content_errors() const { return content_errors_; }
  std::uint64_t arrivals() const { return arrivals_; }

  void record_departures(bool on) { recording_ = on; }
  const std::vector<Departure>& departures(bool down, telemetry::PathId path) const {
    return departures_[down ? 0 : 1][path];
  }

  // Value of this field in the car's sample of this millisecond.
  static double value_of(telemetry::FieldIndex field, std::int64_t sample);

 private:
  // Found by the session number and the packet number in the header.
  struct Sent {
    std::uint16_t receiver = 0;
    std::uint32_t sequence_low = 0;
    std::int64_t sample = -1;
    bool arrived = false;
  };
  struct Side {
    std::array<UdpAddress, telemetry::kPaths> address{};
    std::array<bool, telemetry::kPaths> cut{};
    Instant there{};  // away before this time
  };

  telemetry::LinkEndpointConfig config(bool car) const;
  void deliver();
  void take_at_base(const link::Datagram& datagram, telemetry::PathId path);
  void take_at_car(const link::Datagram& datagram, telemetry::PathId path);
  void tick_car();
  Duration draw_jitter();
  void poll_base();
  void note_departure(bool down, telemetry::PathId path, std::size_t bytes);
  void send(bool down, const telemetry::Outgoing& out);
  Sent& sent_as(const telemetry::Header& header);
  void judge(std::span<const std::uint8_t> datagram, const telemetry::Arrival& arrival);
  void judge_values(telemetry::Group group, std::int64_t sample);
  void look();
  bool arrives(const link::Datagram& datagram, bool down, telemetry::PathId path);

  RadioSetup setup_;
  telemetry::SeededRandomness randomness_;
  telemetry::KeyFile car_keys_, base_keys_;
  std::unique_ptr<telemetry::CarEndpoint> car_;
  std::unique_ptr<telemetry::StationEndpoint> station_;
  std::array<std::unique_ptr<link::LinkEmulator>, telemetry::kPaths> down_, up_;
  Side car_side_, base_side_;
  telemetry::Snapshot snapshot_;
  telemetry::GroupSet sampled_ = telemetry::groups_of(telemetry::Direction::kDown);
  Instant now_{};
  std::int64_t sample_ = 0;  // number of the car's present sample: its millisecond
  Instant next_tick_{};
  std::uint64_t jitter_ = 1;
  std::vector<Sent> sent_;
  std::array<std::int64_t, telemetry::kGroups> sample_at_base_{};
  Tap tap_;
  Stray stray_;
  AgeMeter ages_;
  ContentErrors content_errors_;
  std::uint64_t arrivals_ = 0;
  bool recording_ = false;
  std::array<std::array<std::vector<Departure>, telemetry::kPaths>, 2> departures_;
};

}  // namespace pitwall::radio

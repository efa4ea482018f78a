// What the base station knows and wants: the radio's end, the picture that it gives, ages and
// figures for every outlet, commands and events as they come. The same in the program, the bench
// and the tests.
//   in     datagrams with path, sender and time; the operator's words
//   out    datagrams that are due; picture, figures, logs
//   errors counted by the endpoint; the operator is told what was not understood
//   bound  the newest kLogged commands and events are kept, all are counted
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "basestation/intake/age_book.hpp"
#include "basestation/intake/operator_words.hpp"
#include "basestation/intake/packet_rate.hpp"
#include "basestation/picture/picture.hpp"
#include "protocol/telemetry/endpoint/station_endpoint.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::intake {

struct BulkTally {
  std::uint64_t objects = 0, bytes = 0;
  std::optional<Instant> last;
};

class Station {
 public:
  static constexpr std::size_t kLogged = 1'000;
  // Loss by place is told by sections of this length from the start line.
  static constexpr double kSection_m = 200.0;

  Station(const telemetry::ConduitConfig& config, telemetry::Randomness& randomness)
      : endpoint_(config, randomness), paths_(config.association.paths) {}

  // True: an authentic packet of the car that was not had before.
  bool take(std::span<const std::uint8_t> datagram, telemetry::PathId path, telemetry::Address from,
            Instant received);
  // What the datagram brought that was taken last; none before.
  const std::optional<telemetry::Arrival>& arrival() const { return arrival_; }
  std::optional<telemetry::Outgoing> poll(Instant now);
  Instant due() const { return endpoint_.due(); }
  // Who is told every datagram, as it came (also what is refused) or went. `down`: from the car.
  using Overhearing =
      std::function<void(bool down, telemetry::PathId path, telemetry::Address other, Instant at,
                         std::span<const std::uint8_t> bytes)>;
  void overhear(Overhearing told) { overhearing_ = std::move(told); }
  // Lets the figures grow older; before they are read.
  void advance(Instant now) { ages_.advance(now); }

  Result<Obeyed, Problem> obey(std::string_view words, Instant now);

  enum class Source : std::uint8_t { kNone, kSimulation, kCar };
  Source source() const;
  const picture::Picture& picture() const { return picture_; }
  const PacketRate& rate() const { return rate_; }
  const AgeBook& ages() const { return ages_; }
  std::uint8_t paths() const { return paths_; }
  telemetry::LinkReport report(Instant now) const { return endpoint_.report(now); }
  const telemetry::StationEndpoint& endpoint() const { return endpoint_; }
  telemetry::StationEndpoint& endpoint() { return endpoint_; }

  const std::deque<telemetry::CommandProgress>& commands() const { return commands_; }
  // Of the car, and the attacks and key errors that the base itself sees.
  const std::deque<telemetry::Event>& events() const { return events_; }
  std::uint64_t commands_given() const { return commands_given_; }
  std::uint64_t events_heard() const { return events_heard_; }
  std::uint64_t words_refused() const { return words_refused_; }
  const std::optional<Problem>& last_refused() const { return last_refused_; }
  const std::array<BulkTally, telemetry::kBulkKinds>& bulk() const { return bulk_; }
  // Numbers of packets that came by no path, of all sessions.
  std::uint64_t lost_packets() const;
  double loss() const;  // of those that were sent, 0 .. 1

 private:
  void note(const telemetry::ThreatChange& change);
  void count(const telemetry::Arrival& arrival);
  void collect();

  telemetry::StationEndpoint endpoint_;
  std::uint8_t paths_;
  Overhearing overhearing_;
  std::optional<telemetry::Arrival> arrival_;
  picture::Picture picture_;
  PacketRate rate_;
  AgeBook ages_;
  std::deque<telemetry::CommandProgress> commands_;
  std::deque<telemetry::Event> events_;
  std::uint64_t commands_given_ = 0, events_heard_ = 0, words_refused_ = 0;
  std::optional<Problem> last_refused_;
  std::array<BulkTally, telemetry::kBulkKinds> bulk_{};
  std::uint64_t numbers_before_ = 0, newest_ = 0, session_ = 0;  // of sessions that are over
};

}  // namespace pitwall::intake

// Publisher of messages about changes in one car's service: alarms, tickets, audit, authority,
// events, settings, the radio.
//   in     the service after each advance()
//   out    messages in its MessageLog
//   invariants  only changes are published. Exceptions: the authority each second while it is held,
//          the radio twice a second, the checklist once a second, and the entries each minute, so
//          that the newest part of a recording has them
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "basestation/alarms/notices.hpp"
#include "basestation/command/command_queue.hpp"
#include "basestation/link/station.hpp"
#include "basestation/state/known.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::service {

class CarService;
class MessageLog;

class MessagePublisher {
 public:
  void publish(const CarService& car, MessageLog& to, Instant now);
  // Publishes on a change of the link state, otherwise twice a second.
  void publish_link(const CarService& car, MessageLog& to, Instant now);

 private:
  static constexpr Duration kChecksEvery = seconds(1), kLinkEvery = milliseconds(500),
                            kEntriesEvery = seconds(60), kFuelEvery = milliseconds(100),
                            kStopEvery = milliseconds(200);

  void publish_identity(const CarService& car, MessageLog& to, Instant now);
  void publish_alarms(const CarService& car, MessageLog& to, Instant now);
  void publish_stop(const CarService& car, MessageLog& to, Instant now);
  void publish_commands(const CarService& car, MessageLog& to, Instant now);
  void publish_tickets(const command::CommandQueue& queue, MessageLog& to, Instant now);
  void publish_fuel(const CarService& car, MessageLog& to, Instant now);
  void publish_events(const CarService& car, MessageLog& to, Instant now);
  void publish_settings(const CarService& car, MessageLog& to, Instant now);
  void publish_checks(const CarService& car, MessageLog& to, Instant now);
  void publish_laps(const CarService& car, MessageLog& to, Instant now);

  struct Shown {
    link::Station::Source source = link::Station::Source::kNone;
    std::uint64_t revision = 0;  // of the settings

    bool operator==(const Shown&) const = default;
  };

  bool begun_ = false;
  Shown shown_;
  // Revisions and counts at the last publication.
  std::uint64_t alarms_ = 0, alarm_events_ = 0, notice_revision_ = 0;
  std::uint64_t tickets_ = 0, audit_ = 0, authority_ = 0, events_ = 0, entries_ = 0, settings_ = 0;
  std::uint64_t laps_ = 0;
  std::vector<alarms::Notice> notices_;
  std::string fuel_, stop_;
  Instant authority_at_{}, entries_at_{}, checks_at_{}, link_at_{}, fuel_at_{}, stop_at_{};
  state::LinkState link_ = state::LinkState::kNone;
};

}  // namespace pitwall::service

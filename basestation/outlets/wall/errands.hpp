// What consoles ask for, carried out: all requests but those that the room answers itself.
//   in     a request that was read and whose role was found right; who asks; the time
//   out    acts on the parts of the wall; stops, authority and commands to the station's endpoint
//   law    a stop asks for nothing. What is expected, loaded or set says who holds the authority
//   errors Problem that the console is told; the audit log has refusals of the desks, too
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "basestation/command/authority_talk.hpp"
#include "basestation/command/desk.hpp"
#include "basestation/command/settings_desk.hpp"
#include "basestation/intake/station.hpp"
#include "basestation/outlets/bench/bench_link.hpp"
#include "basestation/outlets/wall/console_room.hpp"
#include "basestation/outlets/web/access.hpp"
#include "basestation/picture/watch/watch.hpp"

namespace pitwall::outlets::wall {

// What people said that no figure of the car says, and who.
struct PeopleSaid {
  picture::Expectations expected;
  std::string round_speed_by, fuel_by;
  Instant fuel_at{};
  std::uint64_t revision = 0;
};

struct ErrandParts {
  picture::Picture& picture;
  picture::Watch& watch;
  command::Audit& audit;
  command::AuthorityTalk& talk;
  command::Desk& desk;
  command::SettingsDesk& settings;
  PeopleSaid& said;
  ConsoleRoom& room;
  const web::Tokens& tokens;  // of the second person of an override
  bench::BenchLink* bench = nullptr;
};

Result<bool, Problem> carry_out(const Request& request, const ErrandParts& parts,
                                intake::Station& station, const command::Person& by, Instant now);

}  // namespace pitwall::outlets::wall

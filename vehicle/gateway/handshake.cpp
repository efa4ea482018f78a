// SPDX-License-Identifier: Apache-2.0
#include "vehicle/gateway/handshake.hpp"

namespace pitwall::gateway {
namespace {

using world::CtState;
using world::Mode;
using world::SysState;
using world::TrackFlag;
using world::VehicleFlag;

struct Row {
  CtState from;
  std::array<CtState, kCtEvents> to;
};

namespace table {
constexpr CtState k1 = CtState::kPowerOn, k2 = CtState::kInitialized, k3 = CtState::kActuatorTest,
                  k4 = CtState::kCrankReady, k5 = CtState::kCranking, k6 = CtState::kRaceReady,
                  k7 = CtState::kInitDriving, k8 = CtState::kCaution, k9 = CtState::kNominalRace,
                  k10 = CtState::kCoordinatedStop, k11 = CtState::kControlledShutdown,
                  k12 = CtState::kEmergencyShutdown, kD = CtState::kDefault;
// clang-format off
constexpr std::array<Row, 13> kRows{{
  //      Emerg Stop Shut  Red  Tests Orange Engine Armed Roll Yellow Green Disar Time
  {kD,  {{k12, kD,  kD,  k1,  k1,   kD,   kD,   kD,   kD,  kD,   kD,   kD,   kD}}},
  {k1,  {{k12, k1,  k1,  k1,  k1,   k1,   k1,   k1,   k1,  k1,   k1,   k1,   k2}}},
  {k2,  {{k12, k2,  k11, k3,  k3,   k2,   k2,   k2,   k2,  k2,   k2,   k2,   k2}}},
  {k3,  {{k12, k3,  k11, k3,  k4,   k3,   k3,   k3,   k3,  k3,   k3,   k3,   k3}}},
  {k4,  {{k12, k4,  k11, k4,  k4,   k5,   k4,   k4,   k4,  k4,   k4,   k4,   k4}}},
  {k5,  {{k12, k5,  k11, k5,  k5,   k5,   k6,   k5,   k5,  k5,   k5,   k5,   k5}}},
  {k6,  {{k12, k6,  k11, k6,  k6,   k6,   k6,   k7,   k6,  k6,   k6,   k6,   k6}}},
  {k7,  {{k12, k10, k11, k7,  k7,   k7,   k7,   k7,   k8,  k7,   k7,   k6,   k7}}},
  {k8,  {{k12, k10, k11, k10, k8,   k8,   k8,   k8,   k8,  k8,   k9,   k6,   k8}}},
  {k9,  {{k12, k10, k11, k10, k9,   k9,   k9,   k9,   k9,  k8,   k9,   k6,   k9}}},
  {k10, {{k12, k10, k11, k10, k10,  k10,  k10,  k10,  k8,  k10,  k10,  k6,   k10}}},
  {k11, {{k12, k11, k11, k11, k11,  k5,   k11,  k11,  k11, k11,  k11,  k11,  k11}}},
  {k12, {{k12, k12, k12, k12, k12,  k12,  k12,  k12,  k12, k12,  k12,  k12,  k12}}},
}};
// clang-format on
}  // namespace table

constexpr const Row& row_of(CtState ct) {
  const std::size_t index = ct == CtState::kDefault ? 0 : static_cast<std::size_t>(ct);
  return table::kRows[index];
}

template <class Property>
consteval bool every_cell(Property holds) {
  for (const Row& row : table::kRows)
    for (std::size_t e = 0; e < kCtEvents; ++e)
      if (!holds(row.from, static_cast<CtEvent>(e), row.to[e])) return false;
  return true;
}

consteval bool rows_are_in_order() {
  for (const Row& row : table::kRows)
    if (row_of(row.from).from != row.from) return false;
  return true;
}

static_assert(rows_are_in_order());
static_assert(every_cell([](CtState from, CtEvent, CtState to) {
                return from != CtState::kEmergencyShutdown || to == from;
              }),
              "emergency shutdown is left by a restart only");
static_assert(every_cell([](CtState from, CtEvent event, CtState to) {
                const bool shut = to == CtState::kEmergencyShutdown;
                return event == CtEvent::kEmergency ? shut : !shut || from == to;
              }),
              "every emergency, and nothing else, leads to emergency shutdown");
static_assert(every_cell([](CtState from, CtEvent event, CtState to) {
                return event != CtEvent::kStop || !drives(from) || to == CtState::kCoordinatedStop;
              }),
              "a stop ends driving");
static_assert(every_cell([](CtState from, CtEvent event, CtState to) {
                return !drives(to) || to == from || event == CtEvent::kArmed ||
                       event == CtEvent::kRoll ||
                       (drives(from) && (event == CtEvent::kGreen || event == CtEvent::kYellow));
              }),
              "driving begins when armed or rolling, and by nothing else");
static_assert(every_cell([](CtState from, CtEvent event, CtState to) {
                return to != CtState::kControlledShutdown || to == from ||
                       event == CtEvent::kShutdown;
              }),
              "the engine is shut on request only");

constexpr bool tests_done(SysState sys) {
  switch (sys) {
    case SysState::kActuatorTestDone:
    case SysState::kCrankReady:
    case SysState::kPreCrankCheck:
    case SysState::kCranking:
    case SysState::kEngineRunning:
    case SysState::kDriving:
    case SysState::kCrankCheckInit:
    case SysState::kStandby:
      return true;
    default:
      return false;
  }
}

constexpr std::size_t at(CtEvent event) { return static_cast<std::size_t>(event); }

}  // namespace

CtEvents events_of(const HandshakeParams& params, const HandshakeInputs& in) {
  const bool stops = in.mode == Mode::kControlledStop || in.mode == Mode::kHalted;
  const bool red = in.track == TrackFlag::kRed || in.track == TrackFlag::kUnknown;
  const bool kill = in.vehicle == VehicleFlag::kEngineKill;
  const bool halt =
      red || kill || in.vehicle == VehicleFlag::kStop || in.vehicle == VehicleFlag::kUnknown;
  const bool stands = in.speed_mps <= params.standstill_mps;  // unset: false
  // A car that coasts drives on for the drive-by-wire, which has no word for it.
  const bool drives = in.mode == Mode::kDriving || in.mode == Mode::kCoast;
  const bool armed = in.mode == Mode::kStandby || drives;
  const bool orange =
      in.track == TrackFlag::kOrange || in.vehicle == VehicleFlag::kOrangeStartEngine;
  const bool green = in.track == TrackFlag::kGreen || in.track == TrackFlag::kWavingGreen;
  const bool yellow = in.track == TrackFlag::kYellow || in.track == TrackFlag::kChequered;
  const bool running = in.sys == SysState::kEngineRunning || in.sys == SysState::kDriving;
  const bool roll = drives && in.sys == SysState::kDriving && (green || yellow) && !halt;
  CtEvents events{};
  events[at(CtEvent::kEmergency)] = in.mode == Mode::kEmergencyStop || in.operator_emergency ||
                                    in.vehicle == VehicleFlag::kPurpleEmergency || in.engine_off;
  events[at(CtEvent::kStop)] = stops || halt;
  events[at(CtEvent::kShutdown)] = (in.operator_shutdown || kill) && stands;
  events[at(CtEvent::kRed)] = in.track == TrackFlag::kRed;
  events[at(CtEvent::kTestsDone)] = in.track == TrackFlag::kRed && tests_done(in.sys);
  events[at(CtEvent::kOrange)] = orange && armed && !halt;
  events[at(CtEvent::kEngineRunning)] = running;
  events[at(CtEvent::kArmed)] = armed;
  events[at(CtEvent::kRoll)] = roll;
  events[at(CtEvent::kYellow)] = roll && yellow;
  events[at(CtEvent::kGreen)] = roll && green;
  events[at(CtEvent::kDisarmed)] = in.mode == Mode::kDisarmed && stands;
  events[at(CtEvent::kTime)] = true;
  return events;
}

CtState next(CtState ct, const CtEvents& events) {
  const Row& row = row_of(ct);
  for (std::size_t e = 0; e < kCtEvents; ++e)
    if (events[e] && row.to[e] != ct) return row.to[e];
  return ct;
}

CtState handshake(const HandshakeParams& params, HandshakeState& state,
                  const HandshakeInputs& inputs, Instant now) {
  CtEvents events = events_of(params, inputs);
  if (now - state.since < params.dwell)
    for (std::size_t e = at(CtEvent::kShutdown); e < kCtEvents; ++e) events[e] = false;
  const CtState to = next(state.ct, events);
  if (to != state.ct) state = {to, now};
  return state.ct;
}

}  // namespace pitwall::gateway

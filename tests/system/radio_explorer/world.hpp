// State of the radio explorer as one value: both ends of commands, stops and authority, the packets
// between them, and the true events. It is copied, changed by one action, judged, and identified by
// its fingerprint.
//   in     actions
//   out    the next world; the first invariant that it breaks
//   invariants
//          packets carry the state of the real transmitters and are read by the real ledger, view
//          and latch. The radio channel may hold, lose, duplicate and reorder them; packets of a
//          session end with it, as in the association
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "protocol/telemetry/command/authority.hpp"
#include "protocol/telemetry/command/command_ledger.hpp"
#include "protocol/telemetry/command/command_transmitter.hpp"
#include "protocol/telemetry/command/stop_latch.hpp"
#include "protocol/vocabulary/fixed_vector.hpp"
#include "tests/system/radio_explorer/whereabouts.hpp"

namespace pitwall::telemetry {

// Identity of a world: a hash of all state that can change what happens next.
struct Fingerprint {
  std::uint64_t a = 0x9E3779B97F4A7C15ULL, b = 0xC2B2AE3D27D4EB4FULL;

  void add(std::uint64_t word);
  void add(Instant at) { add(static_cast<std::uint64_t>(at.ns)); }
  void add(const std::optional<Instant>& at);
  void add(const CommandTransmitterOf<4>& transmitter);
  void add(const CommandLedgerOf<4>& ledger);
  void add(const AuthorityRegister& transmitter);
  void add(const AuthorityView& view);
  void add(const PathAddresses& addresses);
  void add(const StopTransmitter& transmitter);
  void add(const StopLatch& latch);
};

}  // namespace pitwall::telemetry

namespace pitwall::explorer {

using telemetry::CommandId;
using telemetry::HolderId;

inline constexpr HolderId kA = 1, kB = 2;
// Command numbers of one run of the base, and run numbers of the base; 0 is unused in both.
inline constexpr std::uint8_t kNumbersMax = 8;
inline constexpr std::uint8_t kRunsMax = 4;

enum class Action : std::uint8_t {
  kIssueA,  // a speed limit, by console A
  kIssueB,
  kPress,
  kRelease,
  kTake,      // by console A
  kHandOver,  // to the other console
  kRenew,     // by the present holder
  kBaseSends,
  kCarSends,
  kDeliverUp0,  // and remove the packet
  kDeliverUp1,
  kDeliverUp2,
  kDoubleUp0,  // deliver a copy; the packet stays under way
  kDoubleUp1,
  kDoubleUp2,
  kLoseUp0,
  kLoseUp1,
  kDeliverDown0,
  kDeliverDown1,
  kLoseDown0,
  kHandOut,  // from the ledger to the consumer
  kApply,    // by the consumer
  kWait,     // 1.1 s
  kRestartBase,
  kRestartCar,
  kBaseMoves,  // to its other address, or back
  kCarProbes,  // like kCarSends, to the address on trial
  kRelayUp0,   // a relay delivers a copy from his own address before the packet arrives
};
inline constexpr std::size_t kActions = 28;
const char* text_of(Action action);

// How often each action may still happen; the rest is part of the world.
struct Budget {
  std::uint8_t issues = 0, presses = 0, releases = 0, changes = 0, up = 0, down = 0, doubles = 0,
               waits = 0, base_restarts = 0, car_restarts = 0, moves = 0, relays = 0;
};

// Planted faults, to check that the explorer finds them.
enum class Planted : std::uint8_t {
  kNone,
  kForgetfulLedger,     // the car forgets the command numbers
  kAgeFromReception,    // the age of a command counts from its reception
  kRenewalAtReception,  // any received packet renews the authority
  kLatchFollows,        // the stop ends when the base sends no stop
  kReleaseAfterPress,   // a release issued before the press cancels the press at the base
  kAnyConsole           // the ledger does not check the issuer of a command
};

enum class Broken : std::uint8_t {
  kNothing,
  kAppliedTwice,
  kAppliedLate,
  kAppliedWithoutAuthority,
  kAppliedOutOfOrder,
  kWrongOutcome,
  kHolderIsOld,
  kStopWentByItself,
  kPressIgnored,
  kPressForgottenAtBase,
  kWrongAddressBelieved,
  kBaseNotFound
};
const char* text_of(Broken broken);

struct UpPacket {
  std::uint8_t run = 0, boot = 0;  // of the session: run of the base, boot of the car
  Instant sent{};
  UpRoute route;
  telemetry::StopState stop;
  std::uint8_t presses = 0;  // number before it was sent
  double holder = 0, epoch = 0, renewal = 0, renewal_age = 0;
  FixedVector<std::uint8_t, 96> body;
};
struct DownPacket {
  std::uint8_t run = 0, boot = 0;
  DownRoute route;
  std::uint16_t challenge = 0;
  FixedVector<std::uint8_t, 72> body;
};

// True events, used only to judge the ends.
struct Truth {
  struct OfCommand {
    Instant issued{};
    std::uint8_t applied = 0;
    std::uint8_t presses = 0;  // number before it was issued
    HolderId issuer = 0;
    bool release = false;
  };
  std::array<std::array<OfCommand, kNumbersMax>, kRunsMax> commands{};
  std::array<Instant, 3> renewed{};  // newest renewal, by console
  std::array<bool, 3> ever_held{};
  std::uint8_t presses = 0;           // in this run of the base
  std::uint8_t presses_received = 0;  // of them, by this run of the car
  std::uint8_t presses_released = 0;  // of them, before the newest applied release was issued
  std::uint8_t releases = 0;          // that opened the latch
  CommandId newest_applied = 0;       // speed limits, in this run of both ends
  double newest_epoch = -1, newest_holder = 0;  // received by this run of the car
};

class World {
 public:
  World(const Budget& budget, Planted planted, PlantedRoam roam = PlantedRoam::kNone);

  bool can(Action action) const;
  Broken act(Action action);  // CHECKs that can(action) is true
  telemetry::Fingerprint fingerprint() const;

 private:
  void by_operator(Action action);
  Broken deliver(Action action);
  Broken by_car_or_fate(Action action);
  void issue(HolderId by);
  void press();
  void release();
  void note_holders();
  void base_sends();
  void car_sends(bool to_trial);
  Broken deliver_up(const UpPacket& packet, bool relayed = false);
  Broken by_roaming(Action action);
  void wait();
  void meet(std::uint8_t run);
  void receive_state(const UpPacket& packet);
  Broken deliver_down(const DownPacket& packet);
  void hand_out();
  telemetry::AuthorityView forged_view(HolderId who) const;
  Broken apply();
  Broken note_applied(const telemetry::DueCommand& due, Truth::OfCommand& truth);
  void restart_base();
  void restart_car();
  Broken judge(telemetry::StopLevel before, bool released) const;
  void fingerprint_truth(telemetry::Fingerprint& print) const;

  Budget left_;
  Planted planted_;
  Instant now_{seconds(100).ns};
  std::uint8_t run_ = 1, boot_ = 1;

  telemetry::CommandTransmitterOf<4> transmitter_;
  telemetry::AuthorityRegister authority_;
  telemetry::StopTransmitter stop_;
  std::uint16_t challenge_known_ = 0;
  std::uint8_t boot_met_ = 1;
  CommandId release_id_ = 0;

  telemetry::CommandLedgerOf<4> ledger_;
  telemetry::AuthorityView view_;
  telemetry::StopLatch latch_;
  std::uint8_t run_met_ = 0;  // run of the base in session with this run of the car; 0: none
  std::optional<telemetry::DueCommand> in_hand_;
  std::uint8_t run_in_hand_ = 0;  // run of the base that issued it

  BaseAddressModel where_;
  FixedVector<UpPacket, 3> up_;
  FixedVector<DownPacket, 2> down_;
  Truth truth_;
};

}  // namespace pitwall::explorer

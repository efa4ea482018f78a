// SPDX-License-Identifier: Apache-2.0
#include "tests/system/radio_explorer/world.hpp"

#include <algorithm>

#include "protocol/telemetry/packet/body.hpp"
#include "protocol/vocabulary/check.hpp"

namespace pitwall::explorer {
namespace {

using telemetry::Body;
using telemetry::BodyWriter;
using telemetry::Command;
using telemetry::CommandType;
using telemetry::Direction;
using telemetry::Outcome;
using telemetry::Received;
using telemetry::Record;
using telemetry::StopLevel;
using telemetry::StopReason;

// Twice is longer than a command lives, three times longer than an authority.
constexpr Duration kWaited = milliseconds(1'100);
constexpr std::uint64_t kRunBoots = 1'000, kCarBoots = 2'000;

std::size_t index_of(Action action, Action first) {
  return static_cast<std::size_t>(action) - static_cast<std::size_t>(first);
}

template <class Packets>
void remove(Packets& packets, std::size_t at) {
  Packets rest;
  for (std::size_t i = 0; i < packets.size(); ++i) {
    if (i != at) CHECK(rest.push(packets[i]));
  }
  packets = rest;
}

template <class Bytes>
void fill(Bytes& bytes, std::span<const std::uint8_t> from) {
  for (const std::uint8_t byte : from) CHECK(bytes.push(byte));
}

}  // namespace

World::World(const Budget& budget, Planted planted, PlantedRoam roam)
    : left_(budget),
      planted_(planted),
      transmitter_(kRunBoots + 1),
      ledger_(kCarBoots + 1),
      where_(roam) {
  transmitter_.set_peer_boot(kCarBoots + boot_, now_);
  authority_.take(kA, now_);
  note_holders();
}

bool World::can(Action action) const {
  using enum Action;
  const bool number_left = transmitter_.progress(kNumbersMax - 1) == nullptr;
  switch (action) {
    case kIssueA:
    case kIssueB:
      return left_.issues > 0 && number_left && transmitter_.open() < 3;
    case kPress:
      return left_.presses > 0;
    case kRelease:
      return left_.releases > 0 && challenge_known_ != 0 && number_left && transmitter_.open() < 3;
    case kTake:
      return left_.changes > 0 && authority_.holder(now_) == 0;
    case kHandOver:
    case kRenew:
      return left_.changes > 0 && authority_.holder(now_) != 0;
    case kBaseSends:
      return left_.up > 0 && !up_.full();
    case kCarSends:
      return left_.down > 0 && !down_.full();
    case kDeliverUp0:
    case kDeliverUp1:
    case kDeliverUp2:
      return index_of(action, kDeliverUp0) < up_.size();
    case kDoubleUp0:
    case kDoubleUp1:
    case kDoubleUp2:
      return left_.doubles > 0 && index_of(action, kDoubleUp0) < up_.size();
    case kLoseUp0:
    case kLoseUp1:
      return index_of(action, kLoseUp0) < up_.size();
    case kDeliverDown0:
    case kDeliverDown1:
      return index_of(action, kDeliverDown0) < down_.size();
    case kLoseDown0:
      return !down_.empty();
    case kHandOut:
      return !in_hand_;
    case kApply:
      return in_hand_.has_value();
    case kWait:
      return left_.waits > 0;
    case kRestartBase:
      return left_.base_restarts > 0 && run_ + 1 < kRunsMax;
    case kRestartCar:
      return left_.car_restarts > 0;
    case kBaseMoves:
      return left_.moves > 0;
    case kCarProbes:
      return left_.down > 0 && !down_.full() && where_.on_trial();
    case kRelayUp0:
      return left_.relays > 0 && !up_.empty();
  }
  return false;
}

Broken World::act(Action action) {
  CHECK(can(action));
  const StopLevel before = latch_.level();
  const std::uint8_t releases_before = truth_.releases;
  const std::uint8_t boot_before = boot_;
  Broken broken = Broken::kNothing;
  if (action < Action::kBaseSends) {
    by_operator(action);
  } else if (action < Action::kHandOut) {
    broken = deliver(action);
  } else if (action < Action::kBaseMoves) {
    broken = by_car_or_fate(action);
  } else {
    broken = by_roaming(action);
  }
  if (broken == Broken::kNothing && !where_.found()) broken = Broken::kBaseNotFound;
  note_holders();
  if (broken != Broken::kNothing) return broken;
  return judge(boot_ == boot_before ? before : StopLevel::kNone,
               truth_.releases != releases_before);
}

void World::by_operator(Action action) {
  switch (action) {
    case Action::kIssueA:
      return issue(kA);
    case Action::kIssueB:
      return issue(kB);
    case Action::kPress:
      return press();
    case Action::kRelease:
      return release();
    default:
      break;
  }
  --left_.changes;
  if (action == Action::kTake) authority_.take(kA, now_);
  if (action == Action::kRenew) authority_.renew(authority_.holder(now_), now_);
  if (action == Action::kHandOver) {
    const HolderId from = authority_.holder(now_);
    authority_.hand_over(from, from == kA ? kB : kA, now_);
  }
}

Broken World::deliver(Action action) {
  using enum Action;
  if (action == kBaseSends) {
    base_sends();
  } else if (action == kCarSends) {
    car_sends(false);
  } else if (action < kDoubleUp0) {
    const std::size_t at = index_of(action, kDeliverUp0);
    const UpPacket packet = up_[at];
    remove(up_, at);
    return deliver_up(packet);
  } else if (action < kLoseUp0) {
    --left_.doubles;
    return deliver_up(UpPacket{up_[index_of(action, kDoubleUp0)]});
  } else if (action < kDeliverDown0) {
    remove(up_, index_of(action, kLoseUp0));
  } else if (action < kLoseDown0) {
    const std::size_t at = index_of(action, kDeliverDown0);
    const DownPacket packet = down_[at];
    remove(down_, at);
    return deliver_down(packet);
  } else {
    remove(down_, 0);
  }
  return Broken::kNothing;
}

Broken World::by_car_or_fate(Action action) {
  switch (action) {
    case Action::kHandOut:
      hand_out();
      break;
    case Action::kApply:
      return apply();
    case Action::kWait:
      wait();
      break;
    case Action::kRestartBase:
      restart_base();
      break;
    default:
      restart_car();
  }
  return Broken::kNothing;
}

Broken World::by_roaming(Action action) {
  switch (action) {
    case Action::kBaseMoves:
      --left_.moves;
      where_.base_moves();
      break;
    case Action::kCarProbes:
      car_sends(true);
      break;
    default:
      --left_.relays;
      return deliver_up(UpPacket{up_[0]}, true);
  }
  return Broken::kNothing;
}

// In silence the car opens anew, where the base was proved and where it was told.
void World::wait() {
  --left_.waits;
  now_ += kWaited;
  if (where_.wait() && run_met_ != run_) meet(run_);
}

void World::issue(HolderId by) {
  --left_.issues;
  const auto id = transmitter_.issue({CommandType::kSpeedLimit, 10.0 * by, by}, now_);
  if (id) truth_.commands[run_][*id] = {now_, 0, truth_.presses, by, false};
}

void World::press() {
  --left_.presses;
  ++truth_.presses;
  stop_.demand(StopLevel::kEmergency, StopReason::kOperator);
}

void World::release() {
  --left_.releases;
  const HolderId by = authority_.holder(now_);
  const auto id =
      transmitter_.issue({CommandType::kReleaseStop, double(challenge_known_), by}, now_);
  if (!id) return;
  truth_.commands[run_][*id] = {now_, 0, truth_.presses, by, true};
  release_id_ = *id;
  stop_.release_asked(*id);
}

void World::note_holders() {
  telemetry::Values values;
  const HolderId holder = authority_.holder(now_);
  if (holder == 0) return;
  authority_.put(values, now_);
  truth_.ever_held[holder] = true;
  const double age_ms = values[telemetry::field("authority.renewal_age")];
  truth_.renewed[holder] = std::max(truth_.renewed[holder], now_ - from_seconds(age_ms * 1e-3));
}

void World::base_sends() {
  --left_.up;
  UpPacket packet;
  packet.run = run_;
  packet.boot = boot_met_;
  packet.sent = now_;
  packet.route = where_.base_sends();
  packet.stop = stop_.state();
  packet.presses = truth_.presses;
  telemetry::Values values;
  authority_.put(values, now_);
  packet.holder = values[telemetry::field("authority.holder")];
  packet.epoch = values[telemetry::field("authority.epoch")];
  packet.renewal = values[telemetry::field("authority.renewal")];
  packet.renewal_age = values[telemetry::field("authority.renewal_age")];
  std::array<std::uint8_t, 96> buffer{};
  BodyWriter body(buffer, buffer.size(), Direction::kUp);
  body.begin(now_, 1);
  transmitter_.fill(body, now_);
  fill(packet.body, body.bytes());
  CHECK(up_.push(packet));
}

void World::car_sends(bool to_trial) {
  --left_.down;
  if (run_met_ == 0) meet(run_);  // it opened a session before it could send
  DownPacket packet;
  packet.route = where_.car_sends(to_trial);
  packet.run = run_met_;
  packet.boot = boot_;
  packet.challenge = latch_.challenge();
  std::array<std::uint8_t, 72> buffer{};
  BodyWriter body(buffer, buffer.size(), Direction::kDown);
  body.begin(now_, 1);
  ledger_.fill(body, now_);
  fill(packet.body, body.bytes());
  CHECK(down_.push(packet));
}

void World::meet(std::uint8_t run) {
  ledger_.set_peer_boot(kRunBoots + run);
  view_.base_restarted();
  latch_.base_restarted();
  run_met_ = run;
  truth_.newest_epoch = -1;
  truth_.presses_received = truth_.presses_released = 0;
  truth_.newest_applied = 0;
}

void World::receive_state(const UpPacket& packet) {
  if (packet.run != run_met_) meet(packet.run);
  telemetry::Values values;
  values[telemetry::field("authority.holder")] = packet.holder;
  values[telemetry::field("authority.epoch")] = packet.epoch;
  values[telemetry::field("authority.renewal")] = packet.renewal;
  values[telemetry::field("authority.renewal_age")] = packet.renewal_age;
  Received received;
  received.at = now_;
  received.sent_earliest = packet.sent;
  if (planted_ == Planted::kRenewalAtReception) received.sent_earliest = now_;
  view_.receive(values, received);
  if (packet.epoch >= truth_.newest_epoch) {
    truth_.newest_epoch = packet.epoch;
    truth_.newest_holder = packet.holder;
  }
  if (planted_ == Planted::kLatchFollows && packet.stop.level == StopLevel::kNone) latch_ = {};
  latch_.receive(packet.stop, now_);
  truth_.presses_received = std::max(truth_.presses_received, packet.presses);
}

Broken World::deliver_up(const UpPacket& packet, bool relayed) {
  // Keys of a run of the car that is no more, or of a session before the one in use, open nothing.
  if (packet.boot != boot_ || packet.run < run_met_) return Broken::kNothing;
  if (!where_.car_receives(packet.route, relayed ? kRelay : packet.route.from, now_)) {
    return Broken::kWrongAddressBelieved;
  }
  const std::uint64_t run_word = kRunBoots + packet.run;
  if (planted_ == Planted::kForgetfulLedger && packet.run == run_met_) {
    ledger_ = telemetry::CommandLedgerOf<4>{kCarBoots + boot_};
    ledger_.set_peer_boot(run_word);
  }
  receive_state(packet);
  const auto body = telemetry::parse_body(packet.body.span(), Direction::kUp);
  CHECK(body.has_value());
  Received received;
  received.at = now_;
  received.sent_earliest = planted_ == Planted::kAgeFromReception ? now_ : packet.sent;
  for (const Record& record : body->records) {
    const auto values = telemetry::parse_command(record.payload);
    const bool forge = planted_ == Planted::kAnyConsole && values;
    CHECK(ledger_.take(record, received, forge ? forged_view(values->issuer) : view_));
  }
  return Broken::kNothing;
}

Broken World::deliver_down(const DownPacket& packet) {
  if (!where_.base_receives(packet.route)) return Broken::kNothing;
  if (packet.run != run_ || packet.boot < boot_met_) return Broken::kNothing;
  boot_met_ = packet.boot;
  transmitter_.set_peer_boot(kCarBoots + packet.boot, now_);
  challenge_known_ = packet.challenge;
  const auto body = telemetry::parse_body(packet.body.span(), Direction::kDown);
  CHECK(body.has_value());
  Received received;
  received.at = now_;
  for (const Record& record : body->records) CHECK(transmitter_.take(record, received));
  const telemetry::CommandProgress* released = transmitter_.progress(release_id_);
  if (released != nullptr && released->outcome == Outcome::kApplied) {
    if (planted_ == Planted::kReleaseAfterPress) stop_.release_asked(release_id_);
    stop_.released(release_id_);
    release_id_ = 0;
  }
  for (CommandId id = 1; id < kNumbersMax; ++id) {
    const telemetry::CommandProgress* one = transmitter_.progress(id);
    if (one == nullptr || !one->outcome) continue;
    if (one->outcome == Outcome::kOtherRun) continue;  // a car that is no more may have applied it
    const bool applied = truth_.commands[run_][id].applied > 0;
    if (applied != (one->outcome == Outcome::kApplied)) return Broken::kWrongOutcome;
  }
  return Broken::kNothing;
}

void World::hand_out() {
  if (planted_ == Planted::kAnyConsole) {
    const auto before = ledger_;
    for (HolderId who = kA; who <= kB && !in_hand_; ++who) {
      ledger_ = before;
      in_hand_ = ledger_.take_due(now_, forged_view(who));
    }
  } else {
    in_hand_ = ledger_.take_due(now_, view_);
  }
  run_in_hand_ = in_hand_ ? run_met_ : std::uint8_t{0};
}

// Of a car that takes anybody for the holder.
telemetry::AuthorityView World::forged_view(HolderId who) const {
  telemetry::AuthorityRegister forged;
  forged.take(who, now_);
  telemetry::Values values;
  forged.put(values, now_);
  Received received;
  received.at = now_;
  received.sent_earliest = now_;
  telemetry::AuthorityView view;
  view.receive(values, received);
  return view;
}

Broken World::apply() {
  const telemetry::DueCommand due = *in_hand_;
  in_hand_.reset();
  if (now_ > due.expires) {
    ledger_.decide(due.id, Outcome::kExpired, now_);
    return Broken::kNothing;
  }
  Truth::OfCommand& truth = truth_.commands[run_in_hand_][due.number];
  const HolderId by = due.command.issuer;
  const auto expiry = telemetry::kAuthorityExpiry;
  if (!truth_.ever_held[by] || now_ - truth_.renewed[by] >= expiry) {
    return Broken::kAppliedWithoutAuthority;
  }
  if (due.command.type == CommandType::kReleaseStop) {
    const auto challenge = static_cast<std::uint16_t>(due.command.argument);
    if (!latch_.release(challenge, true)) {
      ledger_.decide(due.id, Outcome::kRefused, now_);
      return Broken::kNothing;
    }
    ++truth_.releases;
    if (run_in_hand_ == run_met_)
      truth_.presses_released = std::max(truth_.presses_released, truth.presses);
  }
  const Broken broken = note_applied(due, truth);
  ledger_.decide(due.id, Outcome::kApplied, now_);
  return broken;
}

Broken World::note_applied(const telemetry::DueCommand& due, Truth::OfCommand& truth) {
  if (due.command.type == CommandType::kSpeedLimit && run_in_hand_ == run_met_) {
    if (due.number < truth_.newest_applied) return Broken::kAppliedOutOfOrder;
    truth_.newest_applied = due.number;
  }
  if (++truth.applied > 1) return Broken::kAppliedTwice;
  if (now_ - truth.issued > row_of(due.command.type).time_to_live) return Broken::kAppliedLate;
  const telemetry::CommandProgress* reported = transmitter_.progress(due.number);
  const bool over = run_in_hand_ == run_ && reported != nullptr && reported->outcome.has_value();
  return over ? Broken::kWrongOutcome : Broken::kNothing;
}

void World::restart_base() {
  --left_.base_restarts;
  where_.base_restarts();
  ++run_;
  transmitter_ = telemetry::CommandTransmitterOf<4>{kRunBoots + run_};
  boot_met_ = boot_;
  transmitter_.set_peer_boot(kCarBoots + boot_, now_);
  authority_ = {};
  stop_ = {};
  challenge_known_ = 0;
  release_id_ = 0;
  truth_.presses = 0;
}

void World::restart_car() {
  --left_.car_restarts;
  where_.car_restarts();
  ++boot_;
  ledger_ = telemetry::CommandLedgerOf<4>{kCarBoots + boot_};
  view_ = {};
  latch_ = {};
  run_met_ = 0;
  in_hand_.reset();
  truth_.presses_received = truth_.presses_released = 0;
  truth_.newest_epoch = -1;
  truth_.newest_applied = 0;
}

Broken World::judge(StopLevel before, bool released) const {
  if (latch_.level() < before && !released) return Broken::kStopWentByItself;
  const bool open = latch_.level() == StopLevel::kNone;
  if (open && truth_.presses_received > truth_.presses_released) return Broken::kPressIgnored;
  const bool silent = stop_.state().level == StopLevel::kNone;
  if (silent && truth_.presses > 0) {
    // Every press was followed by a release that was given after it and applied.
    bool followed = false;
    for (const Truth::OfCommand& one : truth_.commands[run_])
      followed = followed || (one.release && one.applied > 0 && one.presses == truth_.presses);
    if (!followed) return Broken::kPressForgottenAtBase;
  }
  const HolderId holder = view_.holder(now_);
  if (holder == 0) return Broken::kNothing;
  const bool of_newest = truth_.newest_epoch >= 0 && double(holder) == truth_.newest_holder;
  const bool fresh =
      truth_.ever_held[holder] && now_ - truth_.renewed[holder] < telemetry::kAuthorityExpiry;
  return of_newest && fresh ? Broken::kNothing : Broken::kHolderIsOld;
}

telemetry::Fingerprint World::fingerprint() const {
  telemetry::Fingerprint print;
  const Budget& l = left_;
  for (const std::uint8_t n :
       {l.issues, l.presses, l.releases, l.changes, l.up, l.down, l.doubles, l.waits,
        l.base_restarts, l.car_restarts, l.moves, l.relays, run_, boot_, run_met_, boot_met_})
    print.add(n);
  where_.fingerprint(print);
  print.add(now_);
  print.add(transmitter_);
  print.add(authority_);
  print.add(stop_);
  print.add(challenge_known_);
  print.add(release_id_);
  print.add(ledger_);
  print.add(view_);
  print.add(latch_);
  print.add(in_hand_ ? std::uint64_t{in_hand_->number} : 0U);
  print.add(run_in_hand_);
  if (in_hand_) print.add(in_hand_->expires);
  fingerprint_truth(print);
  return print;
}

void World::fingerprint_truth(telemetry::Fingerprint& print) const {
  for (const auto& run : truth_.commands) {
    for (const Truth::OfCommand& one : run) {
      if (one.issued.ns == 0) continue;
      print.add(one.issued);
      print.add(std::uint64_t{one.applied} << 16U | std::uint64_t{one.presses} << 8U | one.issuer);
    }
  }
  for (std::size_t i = 0; i < truth_.renewed.size(); ++i) print.add(truth_.renewed[i]);
  print.add(std::uint64_t{truth_.presses} << 16U | std::uint64_t{truth_.presses_received} << 8U |
            truth_.presses_released);
  print.add(truth_.newest_applied);
  print.add(static_cast<std::uint64_t>(truth_.newest_epoch + 1.0));
  print.add(static_cast<std::uint64_t>(truth_.newest_holder));
  // The air has no order.
  telemetry::Fingerprint channel;
  channel.a = channel.b = 0;
  const auto join = [&](const telemetry::Fingerprint& packet) {
    channel.a += packet.a;
    channel.b += packet.b;
  };
  for (const UpPacket& packet : up_) {
    telemetry::Fingerprint one;
    one.add(std::uint64_t{packet.run} << 8U | packet.boot);
    one.add(packet.sent);
    one.add(std::uint64_t{packet.route.from.port} << 8U | packet.route.number);
    one.add(packet.route.proof.value_or(0));
    one.add(static_cast<std::uint64_t>(packet.stop.level) << 8U | packet.stop.epoch);
    one.add(packet.presses);
    for (const double v : {packet.holder, packet.epoch, packet.renewal})
      one.add(static_cast<std::uint64_t>(v));
    one.add(packet.renewal_age >= 0 ? static_cast<std::uint64_t>(packet.renewal_age) : ~0ULL);
    for (const std::uint8_t byte : packet.body) one.add(byte);
    join(one);
  }
  for (const DownPacket& packet : down_) {
    telemetry::Fingerprint one;
    one.add(std::uint64_t{packet.run} << 8U | packet.boot);
    one.add(packet.challenge);
    one.add(std::uint64_t{packet.route.to.ip} << 16U | packet.route.to.port);
    one.add(packet.route.probe.value_or(0));
    for (const std::uint8_t byte : packet.body) one.add(byte);
    join(one);
  }
  print.add(channel.a);
  print.add(channel.b);
}

}  // namespace pitwall::explorer

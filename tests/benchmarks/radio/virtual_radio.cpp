// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/radio/virtual_radio.hpp"

#include <algorithm>
#include <cmath>

#include "protocol/telemetry/packet/header.hpp"
#include "protocol/telemetry/packet/vehicle_state.hpp"
#include "protocol/vocabulary/check.hpp"

namespace pitwall::radio {

using namespace telemetry;  // NOLINT: the bench of this one module

namespace {

// Both clocks began long before the run.
constexpr Duration kUptime = seconds(1'000);
constexpr std::size_t kRemembered = 65'536;  // packets, by their low bits

constexpr UdpAddress kCarAddress{0x0A000001, 4'000}, kBaseAddress{0x0A000002, 5'000};

UdpAddress on_path(UdpAddress address, PathId path) {
  return {address.ip, static_cast<std::uint16_t>(address.port + path)};
}

// A datagram under way: from where, and the port that it goes to.
std::uint64_t tag_of(UdpAddress from, UdpAddress to) {
  return std::uint64_t{from.ip} << 32 | std::uint64_t{from.port} << 16 | to.port;
}
UdpAddress source_of(std::uint64_t tag) {
  return {static_cast<std::uint32_t>(tag >> 32), static_cast<std::uint16_t>(tag >> 16)};
}

struct Steps {
  double min, resolution;
  std::uint64_t count;
};
const auto kSteps = [] {
  std::array<Steps, kFieldCount> steps{};
  for (std::size_t i = 0; i < kFieldCount; ++i) {
    const auto quantized = kFields[i].quantized();
    steps[i] = {quantized.min(), quantized.resolution(), quantized.count()};
  }
  return steps;
}();

}  // namespace

double VirtualRadio::value_of(FieldIndex field, std::int64_t sample) {
  const Steps& steps = kSteps[field];
  std::uint64_t mixed = (static_cast<std::uint64_t>(sample) + 1) * 0x9E3779B97F4A7C15U;
  mixed = (mixed ^ (field + 1) * 0xBF58476D1CE4E5B9U) * 0x94D049BB133111EBU;
  return steps.min + static_cast<double>((mixed >> 24) % steps.count) * steps.resolution;
}

VirtualRadio::VirtualRadio(const RadioSetup& setup)
    : setup_(setup), randomness_(setup.seed), sent_(kRemembered) {
  car_keys_ = {.role = Role::kCar, .own = make_identity(randomness_), .peer = {}};
  base_keys_ = {.role = Role::kBase, .own = make_identity(randomness_), .peer = {}};
  car_keys_.peer = base_keys_.own.public_key;
  base_keys_.peer = car_keys_.own.public_key;
  if (setup.chance != 0) randomness_ = SeededRandomness(~setup.chance);
  for (PathId path = 0; path < kPaths; ++path) {
    car_side_.address[path] = on_path(kCarAddress, path);
    base_side_.address[path] = on_path(kBaseAddress, path);
    down_[path] =
        std::make_unique<link::LinkEmulator>(setup.down[path], link_seed(setup.seed, path, true));
    up_[path] =
        std::make_unique<link::LinkEmulator>(setup.up[path], link_seed(setup.seed, path, false));
  }
  restart_car();
  restart_base();
}

LinkEndpointConfig VirtualRadio::config(bool car) const {
  LinkEndpointConfig config;
  config.association.keys = car ? car_keys_ : base_keys_;
  config.association.greeting.signed_only = setup_.signed_only;
  config.schema = car ? setup_.schema_of_car : setup_.schema_of_base;
  if (car) {
    for (PathId path = 0; path < kPaths; ++path) {
      config.association.peer[path] = on_path(kBaseAddress, path);
      if (setup_.spare[path].known()) {
        CHECK(config.association.spare[path].push(setup_.spare[path]));
      }
    }
    config.association.to_utc = setup_.to_utc;
  }
  config.association.paths = setup_.paths;
  config.association.first_sequence = setup_.first_sequence;
  config.budget = car ? setup_.budget_down : setup_.budget_up;
  config.policy = setup_.policy;
  return config;
}

void VirtualRadio::restart_car(Duration away) {
  car_side_.there = now_ + away;
  car_ = std::make_unique<CarEndpoint>(config(true), randomness_);
  sample_at_base_.fill(-1);
}

void VirtualRadio::restart_base(Duration away) {
  base_side_.there = now_ + away;
  LinkEndpointConfig base = config(false);
  if (station_ && setup_.stamps_kept) base.association.newest_stamp = station_->newest_stamp();
  station_ = std::make_unique<StationEndpoint>(base, randomness_);
  sample_at_base_.fill(-1);
}

Instant VirtualRadio::car_time(Instant air) const { return air + kUptime; }

Instant VirtualRadio::base_time(Instant air) const {
  const double drift_ns = static_cast<double>(air.ns) * setup_.clock_drift_ppm * 1e-6;
  return air + kUptime + setup_.clock_offset + nanoseconds(std::llround(drift_ns));
}

void VirtualRadio::run(Duration length) {
  for (const Instant end = now_ + length; now_ < end;) step();
}

void VirtualRadio::step() {
  deliver();
  if (now_ >= next_tick_) tick_car();
  poll_base();
  look();
  now_ += kStep;
}

void VirtualRadio::deliver() {
  for (PathId path = 0; path < setup_.paths; ++path) {
    while (const auto datagram = down_[path]->take(now_)) take_at_base(*datagram, path);
    while (const auto datagram = up_[path]->take(now_)) take_at_car(*datagram, path);
  }
}

// At the end that it went to, which is there.
bool VirtualRadio::arrives(const link::Datagram& datagram, bool down, PathId path) {
  const Side& side = down ? base_side_ : car_side_;
  const auto port = static_cast<std::uint16_t>(datagram.tag & 0xFFFF);
  if (port == side.address[path].port) return now_ >= side.there;
  if (stray_) stray_(down, path, port, datagram.bytes);
  return false;
}

void VirtualRadio::take_at_car(const link::Datagram& datagram, PathId path) {
  if (!arrives(datagram, false, path)) return;
  car_->feed(datagram.bytes, path, source_of(datagram.tag), car_now());
}

void VirtualRadio::take_at_base(const link::Datagram& datagram, PathId path) {
  if (!arrives(datagram, true, path)) return;
  const auto arrival = station_->feed(datagram.bytes, path, source_of(datagram.tag), base_now());
  if (arrival) judge(datagram.bytes, *arrival);
}

void VirtualRadio::inject(bool at_base, PathId path, UdpAddress from,
                          std::span<const std::uint8_t> bytes) {
  if (path >= setup_.paths || now_ < (at_base ? base_side_ : car_side_).there) return;
  if (!at_base) return car_->feed(bytes, path, from, car_now());
  const auto arrival = station_->feed(bytes, path, from, base_now());
  if (arrival) judge(bytes, *arrival);
}

VirtualRadio::Sent& VirtualRadio::sent_as(const Header& header) {
  return sent_[(header.sequence_low + header.receiver * 40'503U) % kRemembered];
}

void VirtualRadio::judge(std::span<const std::uint8_t> datagram, const Arrival& arrival) {
  ++arrivals_;
  const auto header = parse_header(datagram);
  CHECK(header.has_value());
  Sent& sent = sent_as(*header);
  const bool known = sent.sample >= 0 && sent.receiver == header->receiver &&
                     sent.sequence_low == header->sequence_low &&
                     sent.sequence_low == static_cast<std::uint32_t>(arrival.sequence);
  if (!known) {
    ++content_errors_.never_sampled;
    return;
  }
  if (sent.arrived) ++content_errors_.repeated;
  sent.arrived = true;
  for (const GroupRow& row : kGroupTable) {
    if (!arrival.groups.has(row.group)) continue;
    std::int64_t& sample = sample_at_base_[index_of(row.group)];
    if (sent.sample < sample) ++content_errors_.went_back;
    sample = sent.sample;
    const Instant reported = station_->state().at(row.group);
    const Instant truth = base_time(Instant{} + kStep * sent.sample);
    if (station_->clock_known() && reported > truth) ++content_errors_.too_young;
    judge_values(row.group, sent.sample);
  }
}

void VirtualRadio::judge_values(Group group, std::int64_t sample) {
  const auto [first, count] = fields_of(group);
  for (FieldIndex i = first; i < first + count; ++i) {
    if (station_->state().values[i] != value_of(i, sample)) ++content_errors_.never_sampled;
  }
}

Duration VirtualRadio::draw_jitter() {
  jitter_ = jitter_ * 6'364'136'223'846'793'005U + 1;  // Knuth, MMIX
  return kStep * static_cast<std::int64_t>(
                     (jitter_ >> 33) % static_cast<std::uint64_t>(setup_.tick_jitter / kStep + 1));
}

void VirtualRadio::tick_car() {
  const std::int64_t ticks = (now_ - Instant{}) / kTick;
  next_tick_ = Instant{} + kTick * (ticks + 1) + draw_jitter();
  sample_ = (now_ - Instant{}) / kStep;
  for (FieldIndex i = 0; i < kFieldCount; ++i) snapshot_.values[i] = value_of(i, sample_);
  for (const GroupRow& row : kGroupTable) {
    if (sampled_.has(row.group)) snapshot_.at(row.group) = car_now();
  }
  if (now_ < car_side_.there) return;
  while (const auto out = car_->poll(snapshot_, car_now())) send(true, *out);
}

void VirtualRadio::poll_base() {
  if (now_ < base_side_.there || station_->due() > base_now()) return;
  while (const auto out = station_->poll(base_now())) send(false, *out);
}

void VirtualRadio::send(bool down, const Outgoing& out) {
  note_departure(down, out.path, out.bytes.size());
  const auto header = parse_header(out.bytes);
  CHECK(header.has_value());
  const bool data = header->kind == Kind::kSealed || header->kind == Kind::kSigned;
  if (down && data) {
    Sent& sent = sent_as(*header);
    // A copy for the other path is the same packet.
    const bool copy = sent.receiver == header->receiver && sent.sample == sample_ &&
                      sent.sequence_low == header->sequence_low;
    if (!copy) sent = {header->receiver, header->sequence_low, sample_, false};
  }
  if (tap_ && !tap_(down, out.path, out.bytes)) return;
  Side& side = down ? car_side_ : base_side_;
  if (side.cut[out.path]) return;
  link::LinkEmulator& link = down ? *down_[out.path] : *up_[out.path];
  link.offer(out.bytes, now_, tag_of(side.address[out.path], out.to));
}

void VirtualRadio::note_departure(bool down, PathId path, std::size_t bytes) {
  if (recording_) departures_[down ? 0 : 1][path].push_back({now_, bytes + kIpUdpOverhead});
}

void VirtualRadio::cut(PathId path, bool down, bool up) {
  car_side_.cut[path] = down;
  base_side_.cut[path] = up;
}

void VirtualRadio::move_car(PathId path, UdpAddress source) { car_side_.address[path] = source; }
void VirtualRadio::move_base(PathId path, UdpAddress source) { base_side_.address[path] = source; }

std::optional<Instant> VirtualRadio::sample_at_base(Group group) const {
  const std::int64_t sample = sample_at_base_[index_of(group)];
  if (sample < 0) return {};
  return Instant{} + kStep * sample;
}

void VirtualRadio::look() {
  for (const GroupRow& row : kGroupTable) {
    const std::int64_t sample = sample_at_base_[index_of(row.group)];
    if (sample >= 0) ages_.look(row.group, now_ - (Instant{} + kStep * sample));
  }
  std::int64_t oldest = sample_;
  for (const Group group : kVehicleStateGroups) {
    oldest = std::min(oldest, sample_at_base_[index_of(group)]);
  }
  if (oldest >= 0) ages_.look_at_state(now_ - (Instant{} + kStep * oldest));
}

}  // namespace pitwall::radio

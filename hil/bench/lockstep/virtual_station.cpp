// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/lockstep/virtual_station.hpp"

#include <algorithm>
#include <utility>

#include "protocol/vocabulary/check.hpp"

namespace pitwall::bench {
namespace {

using faults::BenchFaultKind;
using telemetry::PathId;

constexpr std::uint32_t kHere = 0x7F000001;
constexpr std::uint16_t kBasePort = 23'431, kSparePort = 23'441, kMovedPort = 23'451;
constexpr Duration kEarly = milliseconds(2);  // as vehicle/io/radio.hpp

std::uint8_t paths_of(const scenario::Scenario& scenario) {
  return static_cast<std::uint8_t>(std::max<std::size_t>(1, scenario.radio.size()));
}

UdpAddress on_path(std::uint16_t port, PathId path) {
  return {kHere, static_cast<std::uint16_t>(port + path)};
}

}  // namespace

telemetry::LinkEndpointConfig endpoint_config_of(const pipeline::RadioParams& params,
                                                 const telemetry::KeyFile& keys,
                                                 std::uint8_t paths) {
  telemetry::LinkEndpointConfig config;
  config.association.keys = keys;
  config.association.greeting.signed_only = params.signed_only;
  config.association.paths = paths;
  for (std::size_t i = 0; i < paths; ++i) {
    const pipeline::RadioPathParams path =
        i < params.paths.size() ? params.paths[i] : pipeline::RadioPathParams{};
    config.budget[i] = {.bytes_per_s = path.bytes_per_s,
                        .packets_per_s = path.packets_per_s,
                        .safety_bytes_per_s = path.safety_bytes_per_s};
    if (keys.role == telemetry::Role::kCar)
      config.association.peer[i] = on_path(kBasePort, static_cast<PathId>(i));
  }
  return config;
}

VirtualStation::VirtualStation(const scenario::Scenario& scenario, const pipeline::Setup& setup,
                               const FaultPlan& faults)
    : scenario_(scenario),
      setup_(setup),
      processes_(faults.processes),
      randomness_(scenario.seed),
      channel_(scenario.radio, faults.radio, scenario.seed) {
  car_keys_.role = telemetry::Role::kCar;
  base_keys_.role = telemetry::Role::kBase;
  car_keys_.own = telemetry::make_identity(randomness_);
  base_keys_.own = telemetry::make_identity(randomness_);
  car_keys_.peer = base_keys_.own.public_key;
  base_keys_.peer = car_keys_.own.public_key;
  restart_car();
  start_base();
}

bool VirtualStation::active(BenchFaultKind kind, Instant at) const {
  return std::any_of(processes_.begin(), processes_.end(), [&](const faults::BenchFault& fault) {
    return fault.kind == kind && faults::active(fault, at);
  });
}

bool VirtualStation::has(BenchFaultKind kind) const {
  return std::ranges::find(processes_, kind, &faults::BenchFault::kind) != processes_.end();
}

telemetry::LinkEndpointConfig VirtualStation::config(const telemetry::KeyFile& keys) const {
  telemetry::LinkEndpointConfig config =
      endpoint_config_of(setup_.params.radio, keys, paths_of(scenario_));
  if (keys.role == telemetry::Role::kBase) {
    config.association.newest_stamp = newest_stamp_;
  } else if (has(BenchFaultKind::kBaseReplaced)) {
    for (PathId path = 0; path < config.association.paths; ++path)
      CHECK(config.association.spare[path].push(on_path(kSparePort, path)));
  }
  return config;
}

void VirtualStation::restart_car() {
  car_.emplace(config(car_keys_), randomness_);
  adapter_.emplace();
  log_ = {};
  to_car_.clear();
  car_port_ = static_cast<std::uint16_t>(car_port_ + telemetry::kPaths);
}

void VirtualStation::start_base() {
  base_ = std::make_unique<service::CarService>(service::ServiceConfig{}, config(base_keys_),
                                                randomness_);
  operator_ = inputs::TextOperator{inputs::kScriptPerson};
  issued_ = events_received_ = 0;
  advanced_ = {};
}

void VirtualStation::stop_base() {
  if (base_) newest_stamp_ = base_->link().endpoint().newest_stamp();
  base_.reset();
  to_base_.clear();
}

UdpAddress VirtualStation::base_address(PathId path, Instant at) const {
  if (spare_) return on_path(kSparePort, path);
  return on_path(active(BenchFaultKind::kBaseMoved, at) ? kMovedPort : kBasePort, path);
}

void VirtualStation::advance(Instant at) {
  if (active(BenchFaultKind::kBaseReplaced, at)) {
    stop_base();
    newest_stamp_ = 0;
    spare_ = true;
  } else if (active(BenchFaultKind::kBaseKilled, at)) {
    stop_base();
  } else if (!base_) {
    start_base();
  }
  collect(Way::kDown, to_base_, at);
  if (base_ && !active(BenchFaultKind::kBasePaused, at)) serve_base(at);
  collect(Way::kUp, to_car_, at);
}

// What nobody waits for is lost, as it is with a port that nobody has opened. The tag is the port
// of the base that a datagram comes from or goes to.
void VirtualStation::collect(Way way, std::deque<Waiting>& queue, Instant at) {
  for (PathId path = 0; path < channel_.paths(); ++path) {
    const std::uint64_t here = base_address(path, at).port;
    while (auto datagram = channel_.take(way, path, at))
      if (way == Way::kUp || (base_ && datagram->tag == here))
        queue.push_back({path, *std::move(datagram)});
  }
}

void VirtualStation::serve_base(Instant at) {
  const auto answer = [&] {
    while (const auto out = base_->link().poll(base_time(at)))
      channel_.offer(Way::kUp, out->path, {out->bytes, base_address(out->path, at).port}, at);
  };
  for (const Waiting& came : std::exchange(to_base_, {})) {
    base_->receive(came.datagram.bytes, came.path,
                   {kHere, static_cast<std::uint16_t>(car_port_ + came.path)},
                   base_time(came.datagram.arrives));
    answer();
  }
  run_text_commands(at);
  if (at >= advanced_ + kBaseTurn) {
    advanced_ = at;
    base_->advance(base_time(at));
  }
  answer();
  collect_news();
}

void VirtualStation::run_text_commands(Instant at) {
  const auto& words = scenario_.operator_texts;
  for (; next_text_ < words.size() && Instant{} + words[next_text_].at <= at; ++next_text_) {
    const auto done = operator_.execute(words[next_text_].text, base_->requests(), base_time(at));
    if (!done) refusals_.push_back(words[next_text_].text + ": " + done.error().what);
  }
}

void VirtualStation::collect_news() {
  const command::CommandQueue& queue = base_->requests().queue();
  for (const command::Ticket& ticket : queue.tickets())
    if (ticket.number && *ticket.number > issued_) commands_.push_back(*ticket.number);
  issued_ = queue.issued();
  const link::Station& radio = base_->link();
  const auto fresh = static_cast<std::ptrdiff_t>(radio.events_received() - events_received_);
  events_.insert(events_.end(), radio.events().end() - fresh, radio.events().end());
  events_received_ = radio.events_received();
}

void VirtualStation::receive(pipeline::Inputs& in) {
  for (const Waiting& came : std::exchange(to_car_, {}))
    car_->feed(came.datagram.bytes, came.path,
               {kHere, static_cast<std::uint16_t>(came.datagram.tag)}, came.datagram.arrives);
  adapter_->fill(*car_, in);
}

std::optional<telemetry::Snapshot> VirtualStation::publish(
    const pipeline::Car& car, const pipeline::Inputs& in, const pipeline::Outputs& out,
    const std::array<world::ReceiverTraffic, world::kGnssUnits>& receivers) {
  log_.note(in, out, setup_.track.length_m());
  adapter_->take(*car_, setup_, car, out, in.now);
  if (car_->due() > in.now + kEarly) return std::nullopt;
  pipeline::IoCounters figures;
  figures.steps = car.ticks;
  figures.receivers = receivers;
  adapter_->show(*car_, figures, in.now);
  const telemetry::Snapshot snapshot = pipeline::map_telemetry(
      {.setup = setup_, .car = car, .out = out, .log = log_, .io = figures, .now = in.now});
  while (const auto datagram = car_->poll(snapshot, in.now))
    channel_.offer(Way::kDown, datagram->path, {datagram->bytes, datagram->to.port}, in.now);
  return snapshot;
}

}  // namespace pitwall::bench

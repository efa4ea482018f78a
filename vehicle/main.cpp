// pitwall-vehicle: the on-car process. Wires the pipeline to the outside and turns it at 100 Hz.
// SPDX-License-Identifier: Apache-2.0
#include <cstdio>
#include <memory>

#include "protocol/transport/clock.hpp"
#include "protocol/transport/file.hpp"
#include "protocol/transport/process.hpp"
#include "protocol/transport/realtime.hpp"
#include "vehicle/gateway/bus_identity.hpp"
#include "vehicle/io/arguments.hpp"
#include "vehicle/io/guarded.hpp"
#include "vehicle/io/rim.hpp"
#include "vehicle/io/tally.hpp"
#include "vehicle/parameters/car_file.hpp"
#include "vehicle/parameters/track_file.hpp"
#include "vehicle/pipeline/step.hpp"
#include "vehicle/pipeline/telemetry_tap.hpp"

namespace pitwall {
namespace {

constexpr int kExitFailed = 1, kExitUsage = 2;
constexpr int kPriority = 80;
constexpr std::uint64_t kTelemetryEvery = 2;  // ticks: 50 Hz

int refuse(const Problem& problem) {
  std::fprintf(stderr, "%s\n", to_string(problem).c_str());
  return kExitUsage;
}

Result<pipeline::Setup, Problem> set_up(const io::Arguments& args) {
  const auto car_text = transport::read_file(args.car_file);
  if (!car_text) return Unexpected{car_text.error()};
  const auto car = parameters::read_car(*car_text, args.car_file);
  if (!car) return Unexpected{car.error()};
  const auto track_text = transport::read_file(args.track_file);
  if (!track_text) return Unexpected{track_text.error()};
  const auto track = parameters::read_track(*track_text, args.track_file);
  if (!track) return Unexpected{track.error()};
  pipeline::CarParams params = car->params;
  if (args.no_base) params.watchdog[safety::Stream::kRadio].watched = false;
  return pipeline::prepare(params, *track);
}

void tell(const world::BusIdentity& identity) {
  std::fprintf(stderr, "pitwall-vehicle: %s\n", gateway::sentence(identity).c_str());
}

void tell(safety::Arming arming) {
  if (safety::is_refused(arming))
    std::fprintf(stderr, "pitwall-vehicle: not armed: %s\n", safety::text_of(arming));
}

bool same_identity(const world::BusIdentity& a, const world::BusIdentity& b) {
  return a.verdict == b.verdict && a.difference == b.difference && a.id == b.id;
}

int drive(const pipeline::Setup& setup, const io::Arguments& args, io::Rim& rim,
          io::Guarded& guarded, transport::StopSignal& stop) {
  const auto car = std::make_unique<pipeline::Car>();
  io::StepTally tally;
  io::FrameTotals frames;
  io::LossTally losses;
  world::BusHealth bus;
  safety::Arming arming = safety::Arming::kNotAsked;
  transport::Ticker ticker{setup.params.rates.tick};
  Instant last = transport::monotonic_now() - setup.params.rates.tick;
  while (!stop.raised()) {
    const transport::Tick tick = ticker.next();
    const io::Rim::Heard heard = rim.read();
    const Instant now = transport::monotonic_now();
    const bool may_arm = !rim.listen_only();
    const pipeline::Outputs out = pipeline::step(setup, *car,
                                                 {.now = now,
                                                  .dt = now - last,
                                                  .can = heard.can,
                                                  .sensors = heard.sensors,
                                                  .requests = {.arm = may_arm && args.arm},
                                                  .gnss_byte_at = heard.gnss_byte_at,
                                                  .link = heard.link,
                                                  .radio_at = heard.radio_at,
                                                  .guardian = guarded.view(now),
                                                  .last_run_armed = guarded.barred()});
    guarded.tell(setup, *car, out, false, now);
    rim.write(out.passed.frames.span(), now);
    if (out.bus_guard.restart_now) rim.restart_bus();
    if (const char* refusal = rim.fresh_refusal())
      std::fprintf(stderr, "pitwall-vehicle: %s\n", refusal);
    const Instant done = transport::monotonic_now();
    tally.add(done - now, tick.missed);
    last = now;
    if (!same_identity(out.heard.bus.identity, bus.identity)) tell(out.heard.bus.identity);
    bus = out.heard.bus;
    if (out.chosen.arming != arming) tell(arming = out.chosen.arming);
    losses.add(bus);
    frames.gate_refusals = out.passed.refused_total;
    frames.gate_verdicts = car->gate.verdicts;
    if (car->ticks % kTelemetryEvery != 0) continue;
    auto packet = pipeline::tap(setup, out,
                                {.frames_sent = rim.can().sent,
                                 .tx_drops = rim.tx_drops(),
                                 .steps = tally.steps(),
                                 .missed_deadlines = tally.missed_deadlines(),
                                 .step_time_max_us = tally.take_recent_max_us(),
                                 .heartbeats = rim.heartbeats().accepted,
                                 .heartbeats_refused = rim.heartbeats().refused_total(),
                                 .base_runs = rim.heartbeats().runs,
                                 .round_trip_ms = rim.round_trip_ms(now)},
                                now);
    rim.report(packet, done);
  }
  guarded.finish();
  rim.poll_drops();
  if (args.summary_file.empty()) return 0;
  frames.received = rim.can().received;
  frames.sent = rim.can().sent;
  frames.rx_dropped = rim.can().rx_dropped_queue;
  frames.tx_drops = rim.tx_drops();
  const auto written =
      transport::write_file(args.summary_file, io::summary_json(tally, frames, bus, losses));
  return written ? 0 : (refuse(written.error()), kExitFailed);
}

int run(int argc, const char* const* argv) {
  const auto parsed = io::parse_arguments(argc, argv);
  if (const int* code = std::get_if<int>(&parsed)) return *code;
  const auto& args = std::get<io::Arguments>(parsed);
  auto stop = transport::StopSignal::install();
  if (!stop) return refuse(stop.error());
  const auto setup = set_up(args);
  if (!setup) return refuse(setup.error());
  if (args.check) return 0;
  auto rim = io::Rim::open(args);
  if (!rim) return refuse(rim.error());
  auto guarded = io::Guarded::open(args.guardian, args.arm);
  if (!guarded) return refuse(guarded.error());
  const auto realtime = transport::request_realtime(kPriority);
  std::fprintf(stderr, "pitwall-vehicle: %s on %s, %s, %s%s%s\n", setup->track.name().c_str(),
               args.can_interface.c_str(), gateway::database_text().c_str(),
               transport::to_string(realtime).c_str(), args.simulation ? ", SIMULATION" : "",
               args.no_base ? ", NO BASE STATION WATCHED" : "");
  if (rim->listen_only())
    std::fprintf(stderr, "pitwall-vehicle: %s: LISTEN-ONLY: stays disarmed and sends nothing\n",
                 args.can_interface.c_str());
  if (guarded->barred())
    std::fprintf(stderr, "pitwall-vehicle: %s: NOT ARMED: %s\n", args.guardian.c_str(),
                 io::kBarredText);
  return drive(*setup, args, *rim, *guarded, *stop);
}

}  // namespace
}  // namespace pitwall

int main(int argc, char** argv) { return pitwall::run(argc, argv); }

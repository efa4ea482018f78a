// pitwall-vehicle: the on-car process. Wires the pipeline to the outside and turns it at 100 Hz.
// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cstdio>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "protocol/transport/clock.hpp"
#include "protocol/transport/file.hpp"
#include "protocol/transport/process.hpp"
#include "protocol/transport/realtime.hpp"
#include "vehicle/gateway/bus_identity.hpp"
#include "vehicle/io/arguments/arguments.hpp"
#include "vehicle/io/black_box.hpp"
#include "vehicle/io/car_io.hpp"
#include "vehicle/io/computer_watch.hpp"
#include "vehicle/io/detect/detect_command.hpp"
#include "vehicle/io/guardian_link.hpp"
#include "vehicle/io/perception/car_sensors.hpp"
#include "vehicle/io/radio.hpp"
#include "vehicle/io/report/local_report.hpp"
#include "vehicle/io/report/radio_summary.hpp"
#include "vehicle/io/report/tally.hpp"
#include "vehicle/io/report/tracking_summary.hpp"
#include "vehicle/io/station_addresses.hpp"
#include "vehicle/parameters/car_file.hpp"
#include "vehicle/parameters/car_setup.hpp"
#include "vehicle/parameters/track_file.hpp"
#include "vehicle/pipeline/radio_adapter.hpp"
#include "vehicle/pipeline/step.hpp"
#include "vehicle/pipeline/telemetry_mapper.hpp"
#include "vehicle/pipeline/tick_log.hpp"

namespace pitwall {
namespace {

constexpr int kExitFailed = 1, kExitUsage = 2;
constexpr int kPriority = 80;
constexpr std::uint64_t kReportEvery = 2;  // ticks: 50 Hz
constexpr Duration kSchemaPeriod = seconds(1);
constexpr Duration kAnswerAfter = milliseconds(1'500);
constexpr const char* kNoAnswer =
    "no answer from the base station: it does not run, its address is another, the key files are "
    "not one pair, or only one end is set to signed packets";

int refuse(const Problem& problem) {
  std::fprintf(stderr, "%s\n", to_string(problem).c_str());
  return kExitUsage;
}

Result<std::string, Problem> read_whole(const std::string& path) {
  return transport::read_file(path);
}

Result<pipeline::Setup, Problem> set_up(const io::Arguments& args, parameters::CarFile& car) {
  const auto track_text = transport::read_file(args.track_file);
  if (!track_text) return Unexpected{track_text.error()};
  const auto track = parameters::read_track(*track_text, args.track_file);
  if (!track) return Unexpected{track.error()};
  if (args.no_base) car.params.watchdog[safety::Stream::kRadio].watched = false;
  return parameters::set_up(car, *track, read_whole);
}

void say(const std::string& what) { std::fprintf(stderr, "pitwall-vehicle: %s\n", what.c_str()); }

bool same_identity(const world::BusIdentity& a, const world::BusIdentity& b) {
  return a.verdict == b.verdict && a.difference == b.difference && a.id == b.id;
}

// Everything that the loop touches, opened before its first tick.
struct Parts {
  io::CarIo car_io;
  io::GuardianLink guardian;
  std::optional<io::Radio> radio;  // none: no base station is watched
  io::LocalReport report;
  io::BlackBox box;
  std::unique_ptr<io::ComputerWatch> computer;  // none: the kernel gave no event file
  std::unique_ptr<io::CarSensors> sensors;      // none: no file of sensors is named
};

class Drive {
 public:
  Drive(const pipeline::Setup& setup, const io::Arguments& args, std::string_view car_text,
        Parts parts)
      : setup_(setup),
        args_(args),
        parts_(std::move(parts)),
        adapter_(car_text),
        car_(std::make_unique<pipeline::Car>()),
        log_(std::make_unique<pipeline::TickLog>()) {}

  int run(transport::StopSignal& stop) {
    if (const auto taken = transport::take_turns(); !taken)
      return refuse(taken.error()), kExitFailed;
    transport::Ticker ticker{setup_.params.rates.tick};
    last_ = transport::monotonic_now() - setup_.params.rates.tick;
    while (!stop.raised() && !adapter_.end_asked()) tick(ticker.next());
    parts_.guardian.finish();
    return leave_summary();
  }

 private:
  void tick(const transport::Tick& tick) {
    const Instant begun = transport::monotonic_now();
    const io::CarIo::Received incoming = parts_.car_io.read(parts_.box);
    if (parts_.radio) parts_.radio->receive(parts_.box);
    const Instant now = transport::monotonic_now();
    pipeline::Inputs in{.now = now,
                        .dt = now - last_,
                        .can = incoming.can,
                        .sensors = incoming.sensors,
                        .detections = parts_.sensors ? parts_.sensors->take()
                                                     : std::span<const world::DetectionFrame>{},
                        .requests = {.arm = args_.arm},
                        .may_arm = !parts_.car_io.listen_only(),
                        .gnss_byte_at = incoming.gnss_byte_at,
                        .link = incoming.link,
                        .guardian = parts_.guardian.view(now),
                        .computer = computer(),
                        .last_run_armed = parts_.guardian.barred()};
    if (parts_.radio) adapter_.fill(parts_.radio->endpoint(), in);
    const pipeline::Outputs out = pipeline::step(setup_, *car_, in);
    parts_.guardian.publish(setup_, *car_, out, out.requests.reset, now);
    parts_.car_io.write(out.passed.frames.span(), now);
    if (parts_.sensors) parts_.sensors->report(out.ego);
    parts_.box.tick(in, out.passed.frames.span());
    if (out.bus_guard.restart_now) parts_.car_io.restart_bus();
    tally_.add(transport::monotonic_now() - now, begun - tick.deadline, tick.missed);
    last_ = now;
    log_->note(in, out, setup_.track.length_m());
    note(out);
    if (parts_.radio) adapter_.take(parts_.radio->endpoint(), setup_, *car_, out, now);
    if (parts_.radio) tell_radio(now);
    send_telemetry(out, transport::monotonic_now());
  }

  // What the operator at the car's own terminal is told, and what the summary counts.
  void note(const pipeline::Outputs& out) {
    if (const char* refusal = parts_.car_io.fresh_refusal()) say(refusal);
    if (!same_identity(out.received.bus.identity, bus_.identity))
      say(gateway::sentence(out.received.bus.identity));
    bus_ = out.received.bus;
    if (out.chosen.arming != arming_ && safety::is_refused(out.chosen.arming))
      say(std::string("not armed: ") + safety::text_of(out.chosen.arming));
    arming_ = out.chosen.arming;
    losses_.add(bus_);
    frames_.gate_refusals = out.passed.refused_total;
    frames_.gate_verdicts = car_->gate.verdicts;
    frames_.missed_shifts = car_->control.gear.missed;
    opponents_ = out.opponents;
  }

  // A snapshot is made when somebody shall have it now.
  void send_telemetry(const pipeline::Outputs& out, Instant now) {
    const bool radio_due = parts_.radio && parts_.radio->due(now);
    const bool report_due = parts_.report.on() && car_->ticks % kReportEvery == 0;
    const bool record_due = parts_.box.state_due(car_->ticks);
    if (!radio_due && !report_due && !record_due) return;
    pipeline::IoCounters counters;
    counters.frames_sent = parts_.car_io.can().sent;
    counters.tx_drops = parts_.car_io.tx_drops();
    counters.steps = tally_.steps();
    counters.missed_deadlines = tally_.missed_deadlines();
    counters.step_time_max_us = tally_.take_recent_max_us();
    counters.step_time_p50_us = tally_.recent_median_us();
    for (std::size_t unit = 0; unit < counters.receivers.size(); ++unit)
      counters.receivers[unit] = parts_.car_io.receivers()[unit].traffic();
    show_computer(counters);
    if (parts_.sensors) show_sensors(counters, now);
    if (parts_.radio) adapter_.show(parts_.radio->endpoint(), counters, now);
    const telemetry::Snapshot snapshot = pipeline::map_telemetry(
        {.setup = setup_, .car = *car_, .out = out, .log = *log_, .io = counters, .now = now});
    if (report_due) parts_.report.send(snapshot, now);
    if (record_due) parts_.box.state(snapshot, now);
    if (!radio_due) return;
    parts_.radio->send(snapshot, now, parts_.box);
    tell_schema(now);
  }

  world::ComputerHealth computer() const {
    if (!parts_.computer) return {};
    const io::ComputerReport report = parts_.computer->newest();
    return {report.processor_share, report.memory_mib, report.temperature_c};
  }
  void show_computer(pipeline::IoCounters& counters) const {
    const world::ComputerHealth health = computer();
    counters.processor_share = health.processor_share;
    counters.memory_mib = health.memory_mib;
    counters.temperature_c = health.temperature_c;
  }

  void show_sensors(pipeline::IoCounters& counters, Instant now) const {
    using Sensor = pipeline::IoCounters::Sensor;
    const auto shown = [](const std::optional<io::SensorFigures>& figures) {
      if (!figures) return Sensor{};
      const io::ArrivalFigures& a = figures->arrivals;
      return Sensor{a.rate_hz, a.gap_ms, a.latency_ms, static_cast<double>(figures->drops)};
    };
    const auto sensor = [&](io::SensorType type, std::size_t unit) {
      return shown(parts_.sensors->figures(type, unit, now));
    };
    for (std::size_t i = 0; i < counters.lidars.size(); ++i)
      counters.lidars[i] = sensor(io::SensorType::kPointCloud2, i);
    for (std::size_t i = 0; i < counters.cameras.size(); ++i)
      counters.cameras[i] = sensor(io::SensorType::kDetection2DArray, i);
    counters.lidar_frames = shown(parts_.sensors->lidar_frames(now));
    counters.radar = sensor(io::SensorType::kRadarScan, 0);
  }

  void tell_schema(Instant now) {
    const telemetry::CarEndpoint& radio = parts_.radio->endpoint();
    if (now - schema_looked_at_ < kSchemaPeriod) return;
    schema_looked_at_ = now;
    if (radio.schema_agrees() || !radio.view(now).alive_at || schema_reported_) return;
    schema_reported_ = true;
    say("not armed: the base station understands the radio otherwise and lists what differs");
  }

  // For the operator at the car, who may have no base to look at: attacks and key errors that the
  // car sees, and a base that never answers.
  void tell_radio(Instant now) {
    for (const telemetry::ThreatChange& change : adapter_.threats()) {
      std::array<char, telemetry::kThreatLine> text{};
      const std::string_view line = telemetry::write_line(change, false, text);
      std::fprintf(stderr, "pitwall-vehicle: %.*s\n", static_cast<int>(line.size()), line.data());
      parts_.box.event(line, change.at);
    }
    if (!first_tick_) first_tick_ = now;
    if (silence_reported_ || now - *first_tick_ < kAnswerAfter) return;
    silence_reported_ = true;
    if (parts_.radio->endpoint().report(now).sessions > 0) return;
    std::fprintf(stderr, "pitwall-vehicle: radio: %s\n", kNoAnswer);
    parts_.box.event(kNoAnswer, now);
  }

  int leave_summary() {
    parts_.car_io.poll_drops();
    if (args_.summary_file.empty()) return 0;
    frames_.received = parts_.car_io.can().received;
    frames_.sent = parts_.car_io.can().sent;
    frames_.rx_dropped = parts_.car_io.can().rx_dropped_queue;
    frames_.tx_drops = parts_.car_io.tx_drops();
    const Instant now = transport::monotonic_now();
    io::PartTexts parts{.receivers = io::receivers_json(parts_.car_io.receivers()),
                        .recorder = parts_.box.json(),
                        .tracking = io::tracking_json(car_->tracking.counters, opponents_)};
    if (parts_.radio)
      parts.radio = io::radio_json(parts_.radio->endpoint().report(now), parts_.radio->paths());
    if (parts_.sensors) parts.sensors = parts_.sensors->json(now);
    const auto written = transport::write_file(
        args_.summary_file, io::summary_json(tally_, frames_, bus_, losses_, parts));
    return written ? 0 : (refuse(written.error()), kExitFailed);
  }

  const pipeline::Setup& setup_;
  const io::Arguments& args_;
  Parts parts_;
  pipeline::RadioAdapter adapter_;
  std::unique_ptr<pipeline::Car> car_;
  std::unique_ptr<pipeline::TickLog> log_;
  io::StepTally tally_;
  io::FrameTotals frames_;
  io::LossTally losses_;
  world::BusHealth bus_;
  world::Opponents opponents_;
  safety::Arming arming_ = safety::Arming::kNotRequested;
  bool schema_reported_ = false, silence_reported_ = false;
  std::optional<Instant> first_tick_;
  Instant schema_looked_at_;
  Instant last_;
};

Result<Parts, Problem> open_parts(const io::Arguments& args, const pipeline::Setup& setup,
                                  const std::string& car_text) {
  std::optional<io::Radio> radio;  // first: wrong keys are refused before a bus is touched
  if (!args.keys.empty()) {
    auto opened = io::Radio::open({args.radio, args.keys}, setup.params.radio, !args.simulation);
    if (!opened) return Unexpected{opened.error()};
    radio = *std::move(opened);
  }
  auto car_io = io::CarIo::open(args, setup.params.receivers);
  if (!car_io) return Unexpected{car_io.error()};
  auto guardian = io::GuardianLink::open(args.guardian, args.arm);
  if (!guardian) return Unexpected{guardian.error()};
  auto report =
      io::LocalReport::open(args.local_report, args.simulation ? telemetry::Source::kSimulation
                                                               : telemetry::Source::kCar);
  if (!report) return Unexpected{report.error()};
  auto box = io::BlackBox::open(args.record_folder,
                                {.car = args.car_file,
                                 .car_text = car_text,
                                 .track = args.track_file,
                                 .bank = setup.params.planning.line.bank},
                                args.no_base);
  if (!box) return Unexpected{box.error()};
  auto sensors = io::CarSensors::open({args.sensors_file, args.sensors_domain, args.debug_dds},
                                      setup.track, read_whole);
  if (!sensors) return Unexpected{sensors.error()};
  return Parts{*std::move(car_io), *std::move(guardian), std::move(radio),
               *std::move(report), *std::move(box),      io::ComputerWatch::start(),
               *std::move(sensors)};
}

void introduce(const io::Arguments& args, const pipeline::Setup& setup, Parts& parts) {
  const auto realtime = transport::request_realtime(kPriority);
  say(setup.track.name() + " on " + args.can_interface + ", " + gateway::database_text() + ", " +
      transport::to_string(realtime) + (args.simulation ? ", SIMULATION" : "") +
      (args.clock != transport::kWallClock ? ", TIME OF A BENCH" : "") +
      (args.no_base ? ", NO BASE STATION WATCHED" : "") +
      (parts.radio && parts.radio->bench_keys() ? ", KEYS OF A BENCH" : ""));
  if (parts.car_io.listen_only())
    say(args.can_interface + ": LISTEN-ONLY: stays disarmed and sends nothing");
  if (parts.guardian.barred()) say(args.guardian + ": NOT ARMED: " + io::kBarredText);
}

int run(int argc, const char* const* argv) {
  const std::span words{argv, static_cast<std::size_t>(argc)};
  if (words.size() > 1 && std::string_view{words[1]} == "detect")
    return io::detect_command(words.subspan(2));
  const auto parsed = io::parse_arguments(argc, argv);
  if (const int* code = std::get_if<int>(&parsed)) return *code;
  const auto& args = std::get<io::Arguments>(parsed);
  if (const auto clock = transport::use_clock(args.clock); !clock) return refuse(clock.error());
  auto stop = transport::StopSignal::install();
  if (!stop) return refuse(stop.error());
  auto car = parameters::load_car(args.car_file, read_whole);
  if (!car) return refuse(car.error());
  const auto setup = set_up(args, *car);
  if (!setup) return refuse(setup.error());
  if (args.check) {
    const auto stations = io::parse_station_addresses(args.radio);
    return stations ? 0 : refuse(stations.error());
  }
  auto parts = open_parts(args, *setup, car->text);
  if (!parts) return refuse(parts.error());
  introduce(args, *setup, *parts);
  const auto drive = std::make_unique<Drive>(*setup, args, car->text, *std::move(parts));
  return drive->run(*stop);
}

}  // namespace
}  // namespace pitwall

int main(int argc, char** argv) { return pitwall::run(argc, argv); }

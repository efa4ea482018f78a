// pitwall-guardian: stops the car when its process falls silent. Wires the guardian to its own bus
// socket, its own receivers' ports and the record that it shares with the car's process.
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "protocol/json/json_text.hpp"
#include "protocol/transport/can/can_socket.hpp"
#include "protocol/transport/clock.hpp"
#include "protocol/transport/file.hpp"
#include "protocol/transport/process.hpp"
#include "protocol/transport/realtime.hpp"
#include "vehicle/guardian/guardian.hpp"
#include "vehicle/io/arguments/guardian_arguments.hpp"
#include "vehicle/io/receiver_port.hpp"
#include "vehicle/io/shared_stop.hpp"
#include "vehicle/parameters/car_file.hpp"
#include "vehicle/pipeline/guardian_interface.hpp"

namespace pitwall {
namespace {

constexpr int kExitFailed = 1, kExitUsage = 2;
constexpr int kPriority = 85;  // above the car's process, which it must outlast
constexpr std::size_t kFramesPerRead = 4096;

int refuse(const Problem& problem) {
  std::fprintf(stderr, "pitwall-guardian: %s\n", to_string(problem).c_str());
  return kExitUsage;
}

struct Counts {
  std::uint64_t ticks = 0, missed = 0, received = 0, sent = 0, refused = 0;
  std::int64_t longest_ns = 0;
};

// Bus socket, receiver ports and shared memory of the guardian.
class GuardianIo {
 public:
  static Result<GuardianIo, Problem> open(const io::GuardianArguments& args,
                                          const world::Receivers& receivers) {
    auto can = transport::CanSocket::open(args.can_interface);
    if (!can) return Unexpected{can.error()};
    auto ports = io::open_receivers(args.receivers, receivers);
    if (!ports) return Unexpected{ports.error()};
    auto shared = io::SharedStop::open(args.guardian);
    if (!shared) return Unexpected{shared.error()};
    return GuardianIo{*std::move(can), *std::move(ports), *std::move(shared)};
  }

  // Valid until the next one.
  guardian::Inputs read(Instant now) {
    samples_ = {};
    for (io::ReceiverPort& receiver : receivers_) receiver.read(samples_, now);
    const std::size_t count = can_.receive(frames_);
    known_ = shared_.read(*record_) || known_;
    return {.record = known_ ? record_.get() : nullptr,
            .can = std::span<const can::ReceivedFrame>(frames_).first(count),
            .sensors = samples_,
            .now = now};
  }

  // The status first: nothing is said on the bus before the car's process can know of it.
  void write(const guardian::Status& status, std::span<const can::Frame> frames) {
    shared_.write(status);
    can_.send(frames);
  }

  const transport::CanSocketCounters& can() const { return can_.counters(); }

 private:
  GuardianIo(transport::CanSocket can, std::vector<io::ReceiverPort> receivers,
             io::SharedStop shared)
      : can_(std::move(can)),
        receivers_(std::move(receivers)),
        shared_(std::move(shared)),
        record_(std::make_unique<guardian::CarRecord>()),
        frames_(kFramesPerRead) {}

  transport::CanSocket can_;
  std::vector<io::ReceiverPort> receivers_;
  io::SharedStop shared_;
  std::unique_ptr<guardian::CarRecord> record_;
  bool known_ = false;
  world::SensorInput samples_;
  std::vector<can::ReceivedFrame> frames_;
};

void report(const guardian::Status& s) {
  const char* by = guardian::text_of(s.guidance);
  std::fprintf(stderr, "pitwall-guardian: %s (%s)%s%s\n", guardian::text_of(s.mode),
               guardian::text_of(s.cause), *by != '\0' ? " " : "", by);
}

std::string summary_json(const Counts& c, const guardian::Status& s) {
  return json::Object{}
             .text("mode", guardian::text_of(s.mode))
             .text("cause", guardian::text_of(s.cause))
             .number("takeovers", s.takeovers)
             .number("hand_backs", s.hand_backs)
             .number("ticks", c.ticks)
             .number("missed_ticks", c.missed)
             .number("tick_max_us", c.longest_ns / 1000)
             .number("frames_received", c.received)
             .number("frames_sent", c.sent)
             .number("gate_refusals", c.refused)
             .str() +
         "\n";
}

Counts run_ticks(const guardian::Params& params, guardian::State& state, GuardianIo& guardian_io,
                 transport::StopSignal& stop) {
  Counts counts;
  transport::Ticker ticker{guardian::kTick};
  guardian::Guidance guidance = guardian::Guidance::kNone;
  while (!stop.raised()) {
    const transport::Tick tick = ticker.next();
    const Instant now = transport::monotonic_now();
    const guardian::Output out = guardian::step(params, state, guardian_io.read(now));
    guardian_io.write(state.status, out.frames.span());
    ++counts.ticks;
    counts.missed += tick.missed;
    counts.refused = std::max(counts.refused, out.gate_refusals);
    counts.longest_ns = std::max(counts.longest_ns, (transport::monotonic_now() - now).ns);
    if (out.mode_changed || state.status.guidance != guidance) report(state.status);
    guidance = state.status.guidance;
  }
  counts.received = guardian_io.can().received;
  counts.sent = guardian_io.can().sent;
  return counts;
}

int run(int argc, const char* const* argv) {
  const auto parsed = io::parse_guardian_arguments(argc, argv);
  if (const int* code = std::get_if<int>(&parsed)) return *code;
  const auto& args = std::get<io::GuardianArguments>(parsed);
  if (const auto clock = transport::use_clock(args.clock); !clock) return refuse(clock.error());
  auto stop = transport::StopSignal::install();
  if (!stop) return refuse(stop.error());
  const auto car = parameters::load_car(
      args.car_file, [](const std::string& path) { return transport::read_file(path); });
  if (!car) return refuse(car.error());
  if (args.check) return 0;
  auto guardian_io = GuardianIo::open(args, car->params.receivers);
  if (!guardian_io) return refuse(guardian_io.error());
  const auto realtime = transport::request_realtime(kPriority);
  std::fprintf(stderr, "pitwall-guardian: on %s, %s, %s%s\n", args.can_interface.c_str(),
               io::shared_stop_path(args.guardian).c_str(), transport::to_string(realtime).c_str(),
               args.simulation ? ", SIMULATION" : "");
  if (const auto taken = transport::take_turns(); !taken) return refuse(taken.error());
  const auto state = std::make_unique<guardian::State>();
  const Counts counts =
      run_ticks(pipeline::guardian_params(car->params), *state, *guardian_io, *stop);
  if (args.summary_file.empty()) return 0;
  const auto written =
      transport::write_file(args.summary_file, summary_json(counts, state->status));
  return written ? 0 : (refuse(written.error()), kExitFailed);
}

}  // namespace
}  // namespace pitwall

int main(int argc, char** argv) { return pitwall::run(argc, argv); }

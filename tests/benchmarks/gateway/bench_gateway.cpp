// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/gateway/bench_gateway.hpp"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <string_view>
#include <utility>
#include <vector>

#include "hil/can_bus/bus_verb.hpp"
#include "hil/cli/live/clock_place.hpp"
#include "hil/cli/live/programs.hpp"
#include "protocol/json/json_text.hpp"
#include "protocol/transport/clock.hpp"
#include "protocol/transport/file.hpp"
#include "tests/benchmarks/command_line.hpp"
#include "tests/benchmarks/gateway/gateway_run.hpp"

namespace pitwall::benchmarks {
namespace {

namespace fs = std::filesystem;

constexpr const char* kGnssPorts = "23511,23512";  // nobody sends there
constexpr int kOverhead_s = 90;                    // boot, two starts and stops, on a busy machine

struct Options {
  std::int64_t seconds = 60;
  std::size_t omissions = 400;
  std::uint64_t seed = 1;
  std::int64_t foreign_period_ms = 10;
  std::string json_file, interface = "vcan0", clock = transport::kWallClock;
  bool here = false;
  std::int64_t start_ns = 0;  // of the sender, which is this program again
  std::string figures_file;
};

load::TrafficPlan traffic_of(const Options& options) {
  return {.length = seconds(options.seconds),
          .omissions = options.omissions,
          .seed = options.seed,
          .foreign_period = milliseconds(options.foreign_period_ms)};
}

// Per second: 27,000 of three saturated buses.
std::uint64_t least_rate(const Options& options) {
  return 270'000 / static_cast<std::uint64_t>(options.foreign_period_ms);
}

// What was asked, and whether it held.
class Gates {
 public:
  void ask(const std::string& what, bool held) {
    std::printf("  %-7s %s\n", held ? "held" : "MISSED", what.c_str());
    all_ = all_ && held;
  }
  void equal(const std::string& what, std::uint64_t is, std::uint64_t wanted) {
    ask(what + ": " + std::to_string(is) + " of " + std::to_string(wanted), is == wanted);
  }
  bool all() const { return all_; }

 private:
  bool all_ = true;
};

std::uint64_t count_named(const bench::CarSummary::Counts& counts, std::string_view name) {
  for (const auto& [key, value] : counts)
    if (key == name) return value;
  return 0;
}

void print_figures(const char* name, const GatewayRun& run, const Options& options) {
  const double rate = static_cast<double>(run.sent) / static_cast<double>(options.seconds);
  std::printf("%s: %lld s, %llu frames, %.0f frames/s\n", name,
              static_cast<long long>(options.seconds), static_cast<unsigned long long>(run.sent),
              rate);
  std::printf("  batches late by us       p50 %8.0f  p99 %8.0f  max %8.0f\n",
              run.sender.late.p50_us, run.sender.late.p99_us, run.sender.late.max_us);
  std::printf("  receiver woke late by us p50 %8.0f  p99 %8.0f  max %8.0f\n", run.wake.p50_us,
              run.wake.p99_us, run.wake.max_us);
  std::printf("  step of the car us       p50 %8.0f  p99 %8.0f  max %8.0f\n", run.car.step_p50_us,
              run.car.step_p99_us, run.car.step_max_us);
  std::printf("  the car: %llu ticks, %llu deadlines missed\n",
              static_cast<unsigned long long>(run.car.ticks),
              static_cast<unsigned long long>(run.car.missed_deadlines));
}

// What the car received beside the traffic, by the reason for which it did not count; frames on
// its own identifiers are neither applied nor refused.
void print_others(const bench::CarSummary& car) {
  std::uint64_t known = car.frames_applied;
  for (const auto& [kind, count] : car.refused_by_kind) {
    known += count;
    if (count > 0 && kind != "unknown_id")
      std::printf("          the car refused %llu frames as %s\n",
                  static_cast<unsigned long long>(count), kind.c_str());
  }
  if (car.frames_received > known)
    std::printf("          the car received %llu frames on its own identifiers\n",
                static_cast<unsigned long long>(car.frames_received - known));
}

std::uint64_t lost_in_queue(const bench::CarSummary& car) {
  return car.rx_dropped + count_named(car.link, "lost_in_socket");
}

void judge_traffic(Gates& gates, const GatewayRun& run, const Options& options) {
  const bench::CarSummary& car = run.car;
  gates.ask("at least " + std::to_string(least_rate(options)) + " frames/s",
            run.sent >= least_rate(options) * static_cast<std::uint64_t>(options.seconds));
  gates.equal("frames sent", run.sender.sent, run.sent);
  gates.equal("frames received by the car", car.frames_received, run.sent);
  print_others(car);
  gates.equal("reports of the car applied", car.frames_applied, run.sent_of_car);
  gates.equal("frames of unknown identifiers counted by the car",
              count_named(car.refused_by_kind, "unknown_id"), run.sent - run.sent_of_car);
  gates.equal("frames received by the second receiver", run.listener.received, run.sent);
  gates.equal("frames refused by the second receiver", run.listener.refused, 0);
  gates.equal("lost in the car's receive queue", lost_in_queue(car), 0);
  gates.equal("lost in the interface", count_named(car.link, "lost_in_interface"), 0);
  gates.equal("lost in the second receiver's queue", run.listener_lost_in_queue, 0);
  gates.equal("reports of the car listed", car.losses.size(), car.loss_reports);
}

void judge_losses(Gates& gates, const char* who, const load::LossJudgement& judgement) {
  const std::string by = std::string(" by ") + who;
  gates.equal("omitted frames reported" + by, judgement.reported, judgement.omitted);
  gates.equal("of these within 100 ms", judgement.in_time, judgement.omitted);
  gates.equal("reported twice" + by, judgement.twice, 0);
  gates.equal("false reports" + by, judgement.false_reports, 0);
  std::printf(
      "          slowest %.1f ms; %zu reports of frames that were late on the bus, %zu of "
      "the silence at the end; %zu left out that no gap betrayed\n",
      judgement.worst.milliseconds(), judgement.late_on_bus, judgement.after_end, judgement.hidden);
  for (const std::string& error : judgement.errors) std::printf("          %s\n", error.c_str());
}

// Totals since the start, so that a loss outside of the pauses is judged too.
void judge_queue(Gates& gates, const std::vector<load::QueueLoss>& queue) {
  for (const load::QueueLoss& loss : queue) {
    gates.equal(std::string("counted by the kernel for the receiver that paused") +
                    (loss.trailing ? ", nothing after it" : ""),
                loss.counted, loss.missing);
    gates.ask("known " + std::to_string(loss.after.milliseconds()) + " ms after the pause",
              loss.after <= load::kReportLimit);
  }
  gates.ask("the last pause reached beyond the end of the traffic",
            !queue.empty() && queue.back().trailing && queue.back().counted > 0);
}

std::string json_of(const load::LossJudgement& judgement) {
  return json::Object{}
      .number("omitted", judgement.omitted)
      .number("reported", judgement.reported)
      .number("in_time", judgement.in_time)
      .number("twice", judgement.twice)
      .number("false", judgement.false_reports)
      .number("late_on_bus", judgement.late_on_bus)
      .number("after_end", judgement.after_end)
      .number("hidden", judgement.hidden)
      .number("slowest_ms", judgement.worst.milliseconds())
      .str();
}

std::string json_of(const GatewayRun& run) {
  json::Array queue;
  for (const load::QueueLoss& loss : run.queue)
    queue.json(json::Object{}
                   .number("counted", loss.counted)
                   .number("missing", loss.missing)
                   .number("after_ms", loss.after.milliseconds())
                   .flag("trailing", loss.trailing)
                   .str());
  return json::Object{}
      .number("sent", run.sender.sent)
      .number("car_received", run.car.frames_received)
      .number("car_lost_in_queue", lost_in_queue(run.car))
      .number("listener_received", run.listener.received)
      .number("listener_lost_in_queue", run.listener_lost_in_queue)
      .number("late_p99_us", run.sender.late.p99_us)
      .number("late_max_us", run.sender.late.max_us)
      .number("wake_max_us", run.wake.max_us)
      .number("step_p50_us", run.car.step_p50_us)
      .number("step_p99_us", run.car.step_p99_us)
      .number("missed_deadlines", run.car.missed_deadlines)
      .json("by_car", json_of(run.by_car))
      .json("by_listener", json_of(run.by_listener))
      .json("queue", queue.str())
      .str();
}

GatewayPlan plan_of(const Options& options, const std::string& folder) {
  const fs::path build = fs::path(cli::own_program()).parent_path().parent_path();
  return {.interface = options.interface,
          .folder = folder,
          .vehicle = {(build / "vehicle/pitwall-vehicle").string(), "--car",
                      "vehicle/config/cars/av21.yaml", "--track", "vehicle/config/tracks/lvms.yaml",
                      "--gnss", kGnssPorts, "--no-base"},
          .sender = {cli::own_program(), "gateway", "--interface", options.interface, "--seconds",
                     std::to_string(options.seconds), "--omissions",
                     std::to_string(options.omissions), "--seed", std::to_string(options.seed),
                     "--foreign-period", std::to_string(options.foreign_period_ms)},
          .traffic = traffic_of(options),
          .clock = cli::clock_place(options.clock, true).file};
}

int run_here(const Options& options) {
  const auto folder = transport::TemporaryFolder::create("pitwall-gateway-");
  if (!folder) return refuse(folder.error());
  const cli::ClockPlace clock = cli::clock_place(options.clock, true);
  if (!clock.file.empty()) {
    if (const auto used = transport::use_clock(clock.file); !used) return refuse(used.error());
  }
  Gates gates;
  json::Object json;
  json.text("bench", "gateway").number("seconds", options.seconds);
  for (const bool with_losses : {false, true}) {
    Options experiment = options;
    if (!with_losses) experiment.omissions = 0;
    const auto run = run_gateway(plan_of(experiment, folder->path()));
    if (!run) return refuse(run.error());
    print_figures(with_losses ? "loss" : "load", *run, experiment);
    judge_traffic(gates, *run, experiment);
    judge_losses(gates, "the car", run->by_car);
    judge_losses(gates, "the second receiver", run->by_listener);
    judge_queue(gates, run->queue);
    std::fflush(stdout);
    json.json(with_losses ? "loss" : "load", json_of(*run));
  }
  std::error_code none;  // who kept it is gone with its file
  if (clock.is_own) fs::remove(clock.file, none);
  std::printf("gates: %s\n", gates.all() ? "held" : "MISSED");
  if (!options.json_file.empty()) {
    const auto written =
        transport::write_file(options.json_file, json.flag("held", gates.all()).str() + "\n");
    if (!written) return refuse(written.error());
  }
  return gates.all() ? kExitPass : kExitFailed;
}

int run_where_can_is(const Options& options) {
  std::vector<std::string> exec{"exec",
                                "--auto",
                                "--interface",
                                options.interface,
                                "--timeout",
                                std::to_string(2 * options.seconds + kOverhead_s),
                                "--",
                                cli::own_program(),
                                "gateway",
                                "--here",
                                "--interface",
                                options.interface,
                                "--seconds",
                                std::to_string(options.seconds),
                                "--omissions",
                                std::to_string(options.omissions),
                                "--seed",
                                std::to_string(options.seed),
                                "--foreign-period",
                                std::to_string(options.foreign_period_ms),
                                "--clock",
                                options.clock};
  if (!options.json_file.empty())
    exec.insert(exec.end(), {"--json", fs::absolute(options.json_file).string()});
  return can_bus::bus_verb(exec);
}

}  // namespace

int bench_gateway(std::span<const std::string> args) {
  Options options;
  CommandLine app{"pitwall-benchmarks gateway: 27,000 frames/s, and every lost frame reported"};
  app.option("--seconds", options.seconds, "of traffic, for each experiment").range(5, 3'600);
  app.option("--omissions", options.omissions, "single frames to leave out").range(0, 10'000);
  app.option("--seed", options.seed, "of what is left out").range(0, 1'000'000);
  app.option("--foreign-period", options.foreign_period_ms,
             "milliseconds, of 266 identifiers that no database knows: 10 is the traffic of three "
             "saturated buses, 30 of one")
      .range(10, 100);
  app.option("--json", options.json_file, "write the figures here");
  app.option("--interface", options.interface, "CAN interface");
  app.flag("--here", options.here, "the interface exists here already");
  app.option("--clock", options.clock,
             "wall; or bench: its time stands while the machine holds a process up");
  const VerbOption start =
      app.option("--start", options.start_ns, "send only, from this instant on");
  app.option("--figures", options.figures_file, "of the sender").needs(start);
  if (const auto code = app.ended_by(args)) return *code;
  if (start.given()) {
    if (const auto used = transport::use_clock(options.clock); !used) return refuse(used.error());
    const auto sent = send_traffic(options.interface, traffic_of(options), {options.start_ns},
                                   options.figures_file);
    return sent ? kExitPass : refuse(sent.error());
  }
  return options.here ? run_here(options) : run_where_can_is(options);
}

}  // namespace pitwall::benchmarks

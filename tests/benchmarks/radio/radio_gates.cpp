// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/radio/radio_gates.hpp"

#include <cstdint>
#include <cstdio>
#include <ctime>
#include <vector>

#include "protocol/transport/file.hpp"
#include "tests/benchmarks/command_line.hpp"
#include "tests/benchmarks/radio/command_traffic.hpp"
#include "tests/benchmarks/radio/forged_packets.hpp"
#include "tests/benchmarks/radio/gate_table.hpp"
#include "tests/benchmarks/radio/long_gates.hpp"

namespace pitwall::benchmarks {
namespace {

using radio::Gate;
using radio::RadioSetup;
using radio::VirtualRadio;
using telemetry::Group;

constexpr double kRate = 32'000.0;
constexpr Duration kWay = milliseconds(15), kMeanGap = milliseconds(150);
constexpr std::uint64_t kCommands = 100'000, kStops = 100'000, kForgeries = 1'000'000;
constexpr std::size_t kFloodEachMs = 200, kForgeriesEachMs = 50;

struct RadioOptions {
  double hours = 1.0;
  std::uint64_t seed = 1;
  std::string json_file;
};

class Table {
 public:
  void add(const std::string& what, double figure, double limit, const std::string& unit) {
    gates_.push_back({what, unit, figure, limit});
    std::printf("%s\n", line_of(gates_.back()).c_str());
    std::fflush(stdout);
  }
  void none(const std::string& what, std::uint64_t count) {
    add(what, static_cast<double>(count), 0.0, "");
  }
  const std::vector<Gate>& gates() const { return gates_; }

 private:
  std::vector<Gate> gates_;
};

RadioSetup setup_of(link::LinkParams link, std::uint8_t paths, std::uint64_t seed) {
  link.rate_bytes_per_s = kRate;
  link.delay = kWay;
  RadioSetup setup;
  setup.down.fill(link);
  setup.up.fill(link);
  setup.paths = paths;
  setup.seed = seed;
  return setup;
}

RadioSetup lossy(double loss, std::uint8_t paths, std::uint64_t seed) {
  link::LinkParams link;
  link.loss = loss;
  return setup_of(link, paths, seed);
}

void gate_commands(Table& table, const std::string& what, RadioSetup setup, std::uint64_t count,
                   double limit_ms) {
  VirtualRadio radio(setup);
  const radio::CommandFigures f = radio::run_commands(radio, count, kMeanGap);
  std::printf("commands, %s: %llu given, %llu applied, p50 %.0f ms\n", what.c_str(),
              static_cast<unsigned long long>(f.issued), static_cast<unsigned long long>(f.applied),
              f.quantile_ms(0.5));
  table.add(what + ": time to apply p99", f.quantile_ms(0.99), limit_ms, "ms");
  table.none(what + ": without a fate", f.without_fate);
  table.none(what + ": applied twice", f.twice);
  table.none(what + ": applied after their time", f.after_time);
  table.none(what + ": applied after a newer one", f.out_of_order);
  table.none(what + ": fate not as the car had it", f.fate_differs);
  table.none(what + ": values or ages that were false", radio.content_errors().all());
}

void all_commands(Table& table, const RadioOptions& options) {
  const auto share = [&](double of) {
    return static_cast<std::uint64_t>(static_cast<double>(kCommands) * options.hours * of);
  };
  const auto fades = link::bursty(0.5, milliseconds(120), kRate, kWay);
  gate_commands(table, "50 %, one radio", lossy(0.5, 1, options.seed), share(1.0), 160.0);
  gate_commands(table, "50 %, two radios", lossy(0.5, 2, options.seed), share(0.2), 100.0);
  gate_commands(table, "50 % of 120 ms, one", setup_of(fades, 1, options.seed), share(0.2), 600.0);
  gate_commands(table, "50 % of 120 ms, two", setup_of(fades, 2, options.seed), share(0.2), 270.0);
}

void all_stops(Table& table, const RadioOptions& options) {
  const auto trials = static_cast<std::uint64_t>(static_cast<double>(kStops) * options.hours);
  VirtualRadio radio(lossy(0.5, 1, options.seed));
  const radio::StopFigures f = radio::run_stops(radio, trials);
  std::printf("stops at 50 %%: %llu trials\n", static_cast<unsigned long long>(f.trials));
  table.none("stop: not latched by the first packet that arrived", f.late);
  table.none("stop: latch open without a release", f.opened_alone);
  table.none("stop: not released within 10 s", f.not_released);
}

void forgeries(Table& table, const RadioOptions& options) {
  const auto count = static_cast<std::uint64_t>(static_cast<double>(kForgeries) * options.hours);
  VirtualRadio radio(lossy(0.0, 1, options.seed));
  const radio::ForgeryFigures f = radio::run_forgeries(radio, count, kForgeriesEachMs);
  for (std::size_t i = 0; i < radio::kForgeries; ++i) {
    std::printf("forged: %-14s %8llu\n", text_of(static_cast<radio::Forgery>(i)),
                static_cast<unsigned long long>(f.sent[i]));
  }
  table.none("forged, replayed, reflected: accepted", f.accepted);
  table.none("forged: values or ages that were false", radio.content_errors().all());
}

struct Flooded {
  double p99_ms = 0.0, cpu_s = 0.0;
};

Flooded run_flood(std::size_t each_ms, Duration length, std::uint64_t seed) {
  VirtualRadio radio(lossy(0.0, 1, seed));
  radio::PacketForger forger(radio, seed);
  radio.run(seconds(3));
  radio.reset_ages();
  const std::clock_t begin = std::clock();
  for (const Instant end = radio.now() + length; radio.now() < end;) {
    radio.step();
    forger.flood(each_ms);
  }
  const double cpu_s = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
  radio.tap({});
  return {radio.ages().quantile(Group::kMode, 0.99).milliseconds(), cpu_s};
}

void flood(Table& table, const RadioOptions& options) {
  const Duration length = seconds(60);
  const Flooded calm = run_flood(0, length, options.seed);
  const Flooded flooded = run_flood(kFloodEachMs, length, options.seed);
  const double share = (flooded.cpu_s - calm.cpu_s) / length.seconds() * 100.0;
  std::printf("flood of 200,000 forged a second: safety p99 %.0f ms, without %.0f ms\n",
              flooded.p99_ms, calm.p99_ms);
  table.add("flood: safety p99 older by", flooded.p99_ms - calm.p99_ms, 5.0, "ms");
  // Half of them go to each end; with the price of making them, which is the forger's.
  table.add("flood: processor, both ends and the forger", share, 30.0, "% of a core");
}

}  // namespace

int radio_gates(std::span<const std::string> args) {
  CommandLine app{"pitwall-benchmarks radio-gates: the radio's gates at length, in virtual time"};
  RadioOptions options;
  app.option("--hours", options.hours, "share of the whole: 1 is an hour of link")
      .range(0.001, 100.0);
  app.option("--seed", options.seed, "of links and forgers");
  app.option("--json", options.json_file, "the table as JSON");
  if (const auto over = app.ended_by(args)) return *over;

  Table table;
  const auto say = [](const std::string& line) {
    std::printf("%s\n", line.c_str());
    std::fflush(stdout);
  };
  const bool budgets_and_ages = radio::run_long_gates(say, options.hours);
  table.none("budgets and ages, as listed above: missed", budgets_and_ages ? 0 : 1);
  all_commands(table, options);
  all_stops(table, options);
  forgeries(table, options);
  flood(table, options);
  if (!options.json_file.empty()) {
    const auto written = transport::write_file(options.json_file, json_of(table.gates()));
    if (!written) return refuse(written.error());
  }
  std::printf("%s\n", all_held(table.gates()) ? "all gates held" : "GATES MISSED");
  return all_held(table.gates()) ? kExitPass : kExitFailed;
}

}  // namespace pitwall::benchmarks

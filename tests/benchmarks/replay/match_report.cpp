// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/replay/match_report.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "protocol/json/json_text.hpp"
#include "protocol/vocabulary/text.hpp"

namespace pitwall::benchmarks {
namespace {

using replay::Comparison;
using replay::Quantiles;
using replay::TimingErrors;
using Runs = std::vector<Comparison>;

// Times better than that player, in the median of lateness and elsewhere. Inside a burst canplayer
// sends as fast as it can, which happens to be near the gaps of a busy bus: half of its gaps are
// almost right, at wrong times.
struct Peer {
  std::size_t player;
  double least_median_times, least_times;
};
constexpr Peer kPeers[] = {{kCanplayer, 10.0, 5.0}, {kPythonCan, 5.0, 2.0}};
constexpr double kLeastMedianGapTimes = 2.0;
constexpr std::size_t kOwnPlayers[] = {kOurs, kWithSensors};
constexpr const char* kRatioNames[] = {"ours", "ours + sensors"};  // of kOwnPlayers

bool is_whole(const Runs& runs) {
  return !runs.empty() && std::all_of(runs.begin(), runs.end(), [](const Comparison& run) {
    return run.complete() && run.in_order && run.timing;
  });
}

// Medians over the runs; NaN where a run has no timing.
Quantiles median(const Runs& runs, Quantiles TimingErrors::*which) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  std::vector<Quantiles> all;
  for (const Comparison& run : runs)
    if (run.timing) all.push_back((*run.timing).*which);
  if (all.empty() || all.size() < runs.size()) return {kNone, kNone, kNone, kNone};
  return replay::median_of(all);
}

double times(double theirs, double ours) {
  return ours > 0.0 ? theirs / ours : std::numeric_limits<double>::quiet_NaN();
}

std::uint64_t most(const Runs& runs, std::uint64_t Comparison::*which) {
  std::uint64_t out = 0;
  for (const Comparison& run : runs) out = std::max(out, run.*which);
  return out;
}

std::string cells(const Quantiles& q) {
  return formatted(" %8.0f %8.0f %8.0f %8.0f", q.p50_us, q.p90_us, q.p99_us, q.max_us);
}

std::string row(const char* name, const Runs& runs) {
  const bool ordered =
      std::all_of(runs.begin(), runs.end(), [](const Comparison& run) { return run.in_order; });
  return formatted("%-26s", name) + cells(median(runs, &TimingErrors::lateness)) + " |" +
         cells(median(runs, &TimingErrors::gap)) +
         formatted(" | %4llu %5llu  %s\n",
                   static_cast<unsigned long long>(most(runs, &Comparison::lost)),
                   static_cast<unsigned long long>(most(runs, &Comparison::extra)),
                   ordered ? "kept" : "LOST");
}

std::string ratio_row(const char* name, const Runs& theirs, const Runs& ours) {
  std::string out = formatted("%-26s", name);
  for (const auto which : {&TimingErrors::lateness, &TimingErrors::gap}) {
    const Quantiles t = median(theirs, which), o = median(ours, which);
    for (double Quantiles::*const q :
         {&Quantiles::p50_us, &Quantiles::p90_us, &Quantiles::p99_us, &Quantiles::max_us})
      out += formatted(" %7.1fx", times(t.*q, o.*q));
    if (which == &TimingErrors::lateness) out += " |";
  }
  return out + " |\n";
}

std::string json_of(const Quantiles& q) {
  return json::Object{}
      .number("p50_us", q.p50_us)
      .number("p90_us", q.p90_us)
      .number("p99_us", q.p99_us)
      .number("max_us", q.max_us)
      .str();
}

std::string json_of(const Comparison& run) {
  json::Object out;
  out.number("wanted", run.wanted)
      .number("arrived", run.arrived)
      .number("lost", run.lost)
      .number("extra", run.extra)
      .flag("in_order", run.in_order);
  if (run.timing)
    out.json("lateness", json_of(run.timing->lateness)).json("gap_error", json_of(run.timing->gap));
  return out.str();
}

std::string json_of(std::size_t player, const Runs& runs) {
  json::Array each;
  for (const Comparison& run : runs) each.json(json_of(run));
  return json::Object{}
      .text("name", kPlayerNames[player])
      .json("lateness", json_of(median(runs, &TimingErrors::lateness)))
      .json("gap_error", json_of(median(runs, &TimingErrors::gap)))
      .json("runs", each.str())
      .str();
}

DatagramCount sum_of(const SensorArrival& arrival) {
  DatagramCount sum{.in_order = true};
  for (const DatagramCount& one : arrival.receivers) {
    sum.wanted += one.wanted;
    sum.arrived += one.arrived;
    sum.lost += one.lost;
    sum.extra += one.extra;
    sum.in_order = sum.in_order && one.in_order;
  }
  return sum;
}

std::string line_of(const SensorArrival& arrival) {
  const auto number = [](std::uint64_t n) { return std::to_string(n); };
  const DatagramCount sum = sum_of(arrival);
  std::string out = "with sensors, " + std::to_string(kSensorPasses) +
                    " passes: " + number(arrival.frames.arrived) + " frames, " +
                    number(sum.arrived) + " datagrams of " + number(kReceivers) +
                    " receivers; lost " + number(arrival.frames.lost) + " and " + number(sum.lost) +
                    ", extra " + number(arrival.frames.extra) + " and " + number(sum.extra) +
                    (sum.in_order ? "" : "; ORDER of datagrams LOST");
  if (!arrival.order) return out + "; order across tracks not judged\n";
  return out + "; order across tracks: " + number(arrival.order->shown) + " of " +
         number(arrival.order->changes) + " changes shown by arrival, " +
         number(arrival.order->broken) + " broken\n";
}

std::string json_of(const DatagramCount& count) {
  return json::Object{}
      .number("wanted", count.wanted)
      .number("arrived", count.arrived)
      .number("lost", count.lost)
      .number("extra", count.extra)
      .flag("in_order", count.in_order)
      .str();
}

std::string json_of(const SensorArrival& arrival) {
  json::Array receivers;
  for (const DatagramCount& count : arrival.receivers) receivers.json(json_of(count));
  json::Object out;
  out.json("receivers", receivers.str());
  if (arrival.order)
    out.json("order", json::Object{}
                          .number("changes", arrival.order->changes)
                          .number("shown", arrival.order->shown)
                          .number("broken", arrival.order->broken)
                          .str());
  return out.str();
}

std::string json_of(const std::vector<SensorArrival>& runs) {
  json::Array each;
  for (const SensorArrival& run : runs) each.json(json_of(run));
  return json::Object{}
      .number("passes", std::uint64_t{kSensorPasses})
      .json("runs", each.str())
      .str();
}

MatchGate gate_of(const char* text, bool holds) { return {text, holds ? 1.0 : 0.0, 1.0}; }

std::vector<MatchGate> content_gates(const MatchFigures& figures) {
  const auto& sensors = figures.sensors;
  const bool any = !sensors.empty();
  return {
      gate_of("every frame once and in order, every run of ours", is_whole(figures.runs[kOurs])),
      gate_of("with sensors every frame and datagram once and in order, in every pass",
              any && is_whole(figures.runs[kWithSensors]) &&
                  std::ranges::all_of(sensors, &SensorArrival::is_whole)),
      gate_of("with sensors in one order across tracks, in every pass",
              any && std::ranges::all_of(sensors, &SensorArrival::order_is_kept))};
}

void add_ratios(const MatchFigures& figures, const Peer& peer, std::size_t own,
                std::vector<MatchGate>& out) {
  const struct {
    const char* name;
    Quantiles TimingErrors::*which;
    double Quantiles::*share;
    double least;
  } kMeasures[] = {
      {"lateness p50", &TimingErrors::lateness, &Quantiles::p50_us, peer.least_median_times},
      {"lateness p90", &TimingErrors::lateness, &Quantiles::p90_us, peer.least_times},
      {"gap error p50", &TimingErrors::gap, &Quantiles::p50_us, kLeastMedianGapTimes},
      {"gap error p90", &TimingErrors::gap, &Quantiles::p90_us, peer.least_times}};
  for (const auto& measure : kMeasures) {
    const double theirs = median(figures.runs[peer.player], measure.which).*measure.share;
    const double ours = median(figures.runs[kOwnPlayers[own]], measure.which).*measure.share;
    out.push_back({std::string(measure.name) + " of " + kPlayerNames[peer.player] + " over " +
                       kRatioNames[own],
                   times(theirs, ours), measure.least});
  }
}

}  // namespace

std::vector<MatchGate> gates_of(const MatchFigures& figures) {
  std::vector<MatchGate> out = content_gates(figures);
  for (const Peer& peer : kPeers)
    for (std::size_t own = 0; own < std::size(kOwnPlayers); ++own)
      add_ratios(figures, peer, own, out);
  for (const ReadingSpeed& speed : figures.reading)
    out.push_back({"reading " + speed.format + ", ours over python-can",
                   times(speed.ours_per_s, speed.python_per_s), kLeastReadingTimes});
  return out;
}

std::string to_text(const MatchReport& report) {
  const auto& runs = report.figures.runs;
  std::string out = formatted(
      "replay of %llu frames in %.1f s, %zu runs each, one after the other\n",
      static_cast<unsigned long long>(report.frames), report.length_s, runs[kOurs].size());
  out += "medians over the runs, us; load of the host at the start: " + report.host_load + "\n\n";
  out += formatted("%-26s %35s | %35s | %s\n", "", "lateness", "gap error", "worst run");
  out += formatted("%-26s", "");
  for (int i = 0; i < 2; ++i) out += formatted(" %8s %8s %8s %8s |", "p50", "p90", "p99", "max");
  out += " lost extra  order\n";
  for (std::size_t i = 0; i < kPlayers; ++i) out += row(kPlayerNames[i], runs[i]);
  for (const Peer& peer : kPeers)
    for (std::size_t own = 0; own < std::size(kOwnPlayers); ++own)
      out += ratio_row((std::string(kPlayerNames[peer.player]) + "/" + kRatioNames[own]).c_str(),
                       runs[peer.player], runs[kOwnPlayers[own]]);
  out += formatted("%-26s", "sleep alone") + cells(report.figures.noise_floor) +
         " |  (the machine's own lateness, SCHED_FIFO)\n\n";
  for (const SensorArrival& arrival : report.figures.sensors) out += line_of(arrival);
  out += '\n';
  for (const ReadingSpeed& speed : report.figures.reading)
    out += formatted("reading %-8s ours %9.0f frames/s, python-can %9.0f\n", speed.format.c_str(),
                     speed.ours_per_s, speed.python_per_s);
  out += '\n';
  for (const MatchGate& gate : gates_of(report.figures))
    out += formatted("gate: %s: %.1f, at least %.0f: %s\n", gate.text.c_str(), gate.value,
                     gate.least, gate.held() ? "held" : "MISSED");
  return out;
}

std::string to_json(const MatchReport& report) {
  json::Array players, gates;
  for (std::size_t i = 0; i < kPlayers; ++i) players.json(json_of(i, report.figures.runs[i]));
  bool held = true;
  for (const MatchGate& gate : gates_of(report.figures)) {
    gates.json(json::Object{}
                   .text("text", gate.text)
                   .number("value", gate.value)
                   .number("least", gate.least)
                   .flag("held", gate.held())
                   .str());
    held = held && gate.held();
  }
  json::Object out;
  out.text("bench", "replay")
      .number("frames", report.frames)
      .number("length_s", report.length_s)
      .text("host_load", report.host_load)
      .json("players", players.str())
      .json("sensors", json_of(report.figures.sensors))
      .json("sleep_alone", json_of(report.figures.noise_floor))
      .json("gates", gates.str());
  if (!report.figures.own_report.empty()) out.json("own_report", report.figures.own_report);
  if (!report.figures.sensor_report.empty())
    out.json("sensor_report", report.figures.sensor_report);
  return out.flag("held", held).str() + "\n";
}

}  // namespace pitwall::benchmarks

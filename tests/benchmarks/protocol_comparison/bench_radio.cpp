// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/protocol_comparison/bench_radio.hpp"

#include <array>
#include <cstdio>
#include <filesystem>
#include <string_view>
#include <vector>

#include "hil/cli/live/programs.hpp"
#include "hil/link/trace.hpp"
#include "protocol/json/json_text.hpp"
#include "protocol/transport/file.hpp"
#include "tests/benchmarks/command_line.hpp"
#include "tests/benchmarks/protocol_comparison/comparison.hpp"

namespace pitwall::benchmarks {
namespace {

namespace fs = std::filesystem;

constexpr double kRate_bytes_per_s = 32'000.0;  // 256 kbit/s
constexpr double kLoss = 0.3;
constexpr Duration kFade = milliseconds(120), kDelay = milliseconds(15);
constexpr double kLinkKbps = kRate_bytes_per_s * 8e-3;
// In 100 ms a tenth of a second's bytes and one largest packet, a slot of 20 ms of the rate.
constexpr double kWindowKbps = kLinkKbps * 1.2;
constexpr std::string_view kOurs = "pitwall", kSafety = "safety", kWhole = "all 100 signals";
// Ours under overload.
struct AgeLimit {
  std::string_view stream;
  double p50_ms, p99_ms;
};
constexpr std::array kAgeLimits{AgeLimit{kSafety, 40.0, 60.0}, AgeLimit{kWhole, 120.0, 200.0}};
// A contestant whose whole state is at most so much older than ours is named.
constexpr double kNear = 1.25;

constexpr std::array kCases{
    ComparisonCase{"light", false, false},
    ComparisonCase{"overload", true, false},
    ComparisonCase{"overload, queue of 256 ms", true, false, milliseconds(256)},
    ComparisonCase{"overload, queue of 64 ms", true, false, milliseconds(64)},
    ComparisonCase{"fades", false, true},
    ComparisonCase{"overload and fades", true, true}};

struct Options {
  std::int64_t seconds = 20;
  std::uint64_t seed = 1;
  std::string json_file, trace_file, write_trace_file, only, only_case, peers;
};

std::vector<Peer> contestants(const fs::path& folder) {
  const auto program = [&](const char* name) { return (folder / name).string(); };
  return {{std::string(kOurs), program("peer_pitwall"), ""},
          {"protobuf over UDP, 20 Hz", program("peer_protobuf_udp"), ""},
          {"protobuf, bulk paced", program("peer_protobuf_udp"), "paced", true},
          {"LCM", program("peer_lcm_udpm"), ""},
          {"LCM, bulk paced", program("peer_lcm_udpm"), "paced", true},
          {"Cyclone DDS, best effort", program("peer_cyclone_dds"), ""},
          {"Cyclone DDS, reliable", program("peer_cyclone_dds"), "reliable"},
          {"Cyclone DDS, bulk paced", program("peer_cyclone_dds"), "paced", true},
          {"Fast DDS, best effort", program("peer_fast_dds"), ""},
          {"Fast DDS, reliable", program("peer_fast_dds"), "reliable"},
          {"Fast DDS, flow controller", program("peer_fast_dds"), "controlled", true}};
}

Result<link::LinkTrace, Problem> fades_of(const Options& options) {
  if (options.trace_file.empty())
    return link::trace_of(link::bursty(kLoss, kFade, 0.0, {}).fades, options.seed,
                          seconds(options.seconds));
  const auto text = transport::read_file(options.trace_file);
  if (!text) return Unexpected{text.error()};
  return link::read_trace(*text, options.trace_file);
}

void print_heading(const ComparisonCase& of_case) {
  std::printf("\n%s\n%-28s %9s %9s %9s %9s %12s %9s %8s %8s %8s %9s\n",
              std::string(of_case.name).c_str(), "", "age p50", "age p99", "age max", "offered",
              "worst 100 ms", "worst 1 s", "bulk", "uplink", "states", "link late");
}

std::string title_of(const ComparisonRow& row) {
  return row.stream.empty() ? row.contestant : row.contestant + ": " + row.stream;
}

// Rates are of no sender.
void print_floor(const ComparisonRow& row) {
  std::printf("%-28s %9.1f %9.1f %9.1f\n", row.contestant.c_str(), row.age_p50_ms, row.age_p99_ms,
              row.age_max_ms);
}

void print_row(const ComparisonRow& row) {
  std::printf("%-28s %9.1f %9.1f %9.1f %9.0f %12.0f %9.0f %8.0f %8.0f %8zu %9.2f",
              title_of(row).c_str(), row.age_p50_ms, row.age_p99_ms, row.age_max_ms,
              row.offered_kbps, row.worst_window_kbps, row.worst_second_kbps, row.bulk_kbps,
              row.up_kbps, row.states, row.link_late_p99_ms);
  if (row.looks_without > 0) std::printf("  nothing for %zu ms", row.looks_without);
  std::printf("\n");
  std::fflush(stdout);
}

std::string json_of(const ComparisonRow& row) {
  return json::Object{}
      .text("contestant", row.contestant)
      .text("stream", row.stream)
      .text("case", row.of_case)
      .number("age_p50_ms", row.age_p50_ms)
      .number("age_p99_ms", row.age_p99_ms)
      .number("age_max_ms", row.age_max_ms)
      .number("offered_kbps", row.offered_kbps)
      .number("worst_100ms_kbps", row.worst_window_kbps)
      .number("worst_1s_kbps", row.worst_second_kbps)
      .number("bulk_kbps", row.bulk_kbps)
      .number("uplink_kbps", row.up_kbps)
      .number("states", row.states)
      .number("ms_without", row.looks_without)
      .number("link_late_p99_ms", row.link_late_p99_ms)
      .str();
}

bool gate(const std::string& what, double is, double limit) {
  const bool held = is <= limit;  // false for no number
  std::printf("  %-7s %s: %.1f, at most %.0f\n", held ? "held" : "MISSED", what.c_str(), is, limit);
  return held;
}

bool is_overload(std::string_view of_case) {
  for (const ComparisonCase& c : kCases)
    if (c.name == of_case) return c.bulk && !c.fades;
  return false;
}

// Only ours is judged: its rate always, its ages only where the link can carry what they need.
bool judge(const std::vector<ComparisonRow>& rows) {
  bool held = true;
  std::printf("\ngates\n");
  for (const ComparisonRow& row : rows) {
    if (row.contestant != kOurs) continue;
    if (row.stream == kSafety) {
      held &= gate(row.of_case + ": worst 1 s kbit/s", row.worst_second_kbps, kLinkKbps);
      held &= gate(row.of_case + ": worst 100 ms kbit/s", row.worst_window_kbps, kWindowKbps);
    }
    for (const AgeLimit& limit : kAgeLimits) {
      if (row.stream != limit.stream || !is_overload(row.of_case)) continue;
      held &= gate(row.of_case + ": " + row.stream + " age p50 ms", row.age_p50_ms, limit.p50_ms);
      held &= gate(row.of_case + ": " + row.stream + " age p99 ms", row.age_p99_ms, limit.p99_ms);
    }
  }
  return held;
}

// Who comes near ours, the whole state against the whole state.
void compare(const std::vector<ComparisonRow>& rows) {
  std::printf("\nall 100 signals at most %.2f times as old as ours\n", kNear);
  for (const ComparisonRow& ours : rows) {
    if (ours.contestant != kOurs || ours.stream != kWhole) continue;
    for (const ComparisonRow& row : rows) {
      if (row.contestant == kOurs || row.of_case != ours.of_case) continue;
      const bool near =
          row.age_p50_ms <= kNear * ours.age_p50_ms && row.age_p99_ms <= kNear * ours.age_p99_ms;
      if (!near) continue;
      std::printf("  %s: %s, %.1f / %.1f, ours %.1f / %.1f; bulk %.0f, ours %.0f\n",
                  row.of_case.c_str(), row.contestant.c_str(), row.age_p50_ms, row.age_p99_ms,
                  ours.age_p50_ms, ours.age_p99_ms, row.bulk_kbps, ours.bulk_kbps);
    }
  }
}

bool chosen(std::string_view name, const std::string& only) {
  return only.empty() || name.find(only) != std::string_view::npos;
}

Result<std::vector<ComparisonRow>, Problem> hold(const Options& options,
                                                 const ComparisonPlan& plan) {
  std::vector<ComparisonRow> rows;
  for (const ComparisonCase& of_case : kCases) {
    if (!options.only_case.empty() && of_case.name != options.only_case) continue;
    print_heading(of_case);
    print_floor(best_possible(of_case, plan));
    for (const Peer& contestant : contestants(options.peers)) {
      if (!chosen(contestant.name, options.only) || (contestant.tuned && !of_case.bulk)) continue;
      if (!fs::exists(contestant.program)) {
        if (contestant.name == kOurs)
          return Unexpected{Problem{contestant.program, "is not built: target radio_peers"}};
        std::printf("%-28s is not built\n", contestant.name.c_str());
        continue;
      }
      const auto streams = run_comparison(contestant, of_case, plan);
      if (!streams) return Unexpected{streams.error()};
      for (const ComparisonRow& row : *streams) {
        print_row(row);
        rows.push_back(row);
      }
    }
  }
  return rows;
}

Result<bool, Problem> write_json(const Options& options, const std::vector<ComparisonRow>& rows,
                                 bool held) {
  json::Array listed;
  for (const ComparisonRow& row : rows) listed.json(json_of(row));
  return transport::write_file(options.json_file, json::Object{}
                                                          .text("bench", "radio")
                                                          .number("seconds", options.seconds)
                                                          .number("seed", options.seed)
                                                          .json("rows", listed.str())
                                                          .flag("held", held)
                                                          .str() +
                                                      "\n");
}

}  // namespace

int bench_radio(std::span<const std::string> args) {
  Options options;
  options.peers = fs::path(cli::own_program()).parent_path().parent_path() /
                  "tests/benchmarks/protocol_comparison/peers";
  CommandLine app{"pitwall-benchmarks radio: protocols side by side over one emulated radio"};
  app.option("--seconds", options.seconds, "of each case and contestant, after 4 s")
      .range(1, 3'600);
  app.option("--seed", options.seed, "of the fades");
  app.option("--trace", options.trace_file, "recorded fades instead (CSV from_s,to_s[,loss])");
  app.option("--write-trace", options.write_trace_file, "write the fades here");
  app.option("--only", options.only, "contestants whose name contains this");
  app.option("--case", options.only_case, "one only, as the table calls it");
  app.option("--peers", options.peers, "folder of the contestants' programs");
  app.option("--json", options.json_file, "write the figures here");
  if (const auto code = app.ended_by(args)) return *code;
  const auto fades = fades_of(options);
  if (!fades) return refuse(fades.error());
  if (!options.write_trace_file.empty()) {
    const auto written = transport::write_file(options.write_trace_file, link::write_trace(*fades));
    if (!written) return refuse(written.error());
  }
  ComparisonPlan plan;
  plan.link.rate_bytes_per_s = kRate_bytes_per_s;
  plan.link.delay = kDelay;
  plan.fades = *fades;
  plan.length = seconds(options.seconds);
  plan.seed = options.seed;
  std::printf(
      "%.0f kbit/s, queue 16 kB (512 ms), %.0f ms; fades: seed %llu, %zu of them in %lld s; ms and "
      "kbit/s\n",
      kLinkKbps, kDelay.milliseconds(), static_cast<unsigned long long>(options.seed),
      fades->outages.size(), static_cast<long long>(options.seconds));
  const auto rows = hold(options, plan);
  if (!rows) return refuse(rows.error());
  if (rows->empty()) return refuse({"bench radio", "no such contestant or case"});
  compare(*rows);
  const bool held = judge(*rows);
  if (!options.json_file.empty()) {
    if (const auto written = write_json(options, *rows, held); !written)
      return refuse(written.error());
  }
  return held ? kExitPass : kExitFailed;
}

}  // namespace pitwall::benchmarks

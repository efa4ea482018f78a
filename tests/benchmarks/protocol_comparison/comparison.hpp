// Radio protocols side by side: each with its real library in two processes, one in the car's
// network and one in the base's, over the same emulated link with the same fades, one at a time.
//   in     a contestant's program, called as
//            PROGRAM car|base END_NS BULK [MODE]
//          which sends (car) or receives (base) until its monotonic clock shows END_NS; BULK is 1
//          where 4 kB go at 20 Hz beside the state. The base prints "MADE_NS ARRIVED_NS [STREAM]"
//          for each state that came, and "bulk ARRIVED_NS BYTES"; both clocks are the machine's.
//          Streams are judged apart
//   out    how old the newest state at the base is, looked at each millisecond; what was offered to
//          the link, and its worst windows; how much bulk came
//   invariants
//          the fades begin after the warm-up, in which the contestants find each other, and are the
//          same for each contestant under one seed. Only what comes after the warm-up is judged
//   errors Problem that says which program failed and how
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "hil/link/link_params.hpp"
#include "protocol/vocabulary/result.hpp"
#include "protocol/vocabulary/time.hpp"
#include "tests/benchmarks/protocol_comparison/tun_link.hpp"

namespace pitwall::benchmarks {

inline constexpr Duration kRateWindow = milliseconds(100), kLongWindow = seconds(1);

struct Peer {
  std::string name;
  std::string program;
  std::string mode;    // empty: none
  bool tuned = false;  // for the link and the bulk: runs in the cases with bulk only
};

struct ComparisonCase {
  std::string_view name;
  bool bulk = false, fades = false;
  Duration queue{};  // of the link at its rate; zero: as the plan has it
};

struct ComparisonPlan {
  link::LinkParams link;  // of each direction, without fades
  link::LinkTrace fades;  // from the end of the warm-up, in the cases with fades
  Duration length{}, warm_up = seconds(4);
  std::uint64_t seed = 1;
};

struct ComparisonRow {
  std::string contestant, stream, of_case;
  double age_p50_ms = 0.0, age_p99_ms = 0.0, age_max_ms = 0.0;
  double offered_kbps = 0.0, up_kbps = 0.0;
  double worst_window_kbps = 0.0, worst_second_kbps = 0.0;
  double bulk_kbps = 0.0;         // that came
  std::size_t states = 0;         // that came
  std::size_t looks_without = 0;  // before the first came
  double link_late_p99_ms = 0.0;  // of the emulator's deliveries: what the machine added
};

// A row for each stream, in order of first arrival; one without a name where nothing came.
Result<std::vector<ComparisonRow>, Problem> run_comparison(const Peer& contestant,
                                                           const ComparisonCase& of_case,
                                                           const ComparisonPlan& plan);

// Of each direction, from the start of the run.
link::LinkParams link_of(const ComparisonCase& of_case, const ComparisonPlan& plan);

// The floor that the channel sets: a value each millisecond, each as small as nothing, lost only in
// fades. No sender can be younger.
ComparisonRow best_possible(const ComparisonCase& of_case, const ComparisonPlan& plan);

// What a base printed, in order of arrival.
struct StateArrival {
  Instant made{}, at{};
  std::string stream{};
};
struct BulkArrival {
  Instant at{};
  std::size_t bytes = 0;
};
struct Arrivals {
  std::vector<StateArrival> states;
  std::vector<BulkArrival> bulk;
};
Result<Arrivals, Problem> read_arrivals(std::string_view text, const std::string& name);

// Pure: from what came of one stream, of bulk, and what was offered. Times since the start of the
// link.
ComparisonRow judge(const Arrivals& arrivals, const LinkTally& tally, const ComparisonPlan& plan);

}  // namespace pitwall::benchmarks

// Runner of one radio protocol over an emulated link: its real library in two processes, one in the
// car's network and one in the base's. All protocols get the same link and the same fades, one at a
// time.
//   in     the program of a peer, called as
//            PROGRAM car|base END_NS BULK [MODE]
//          which sends (car) or receives (base) until the monotonic clock shows END_NS; with BULK 1
//          it also sends 4 kB of bulk at 20 Hz. The base prints "MADE_NS ARRIVED_NS [STREAM]" for
//          each state that arrives, and "bulk ARRIVED_NS BYTES"; both processes use the clock of
//          the machine. Each stream is judged on its own
//   out    age of the newest state at the base, sampled each millisecond; what was offered to the
//          link, and its worst windows; how much bulk arrived
//   invariants
//          the fades begin after the warm-up, in which the two processes find each other; under one
//          seed they are the same for each peer. Only the time after the warm-up is judged
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
  bool tuned = false;  // to the link and the bulk: runs only in the cases with bulk
};

struct ComparisonCase {
  std::string_view name;
  bool bulk = false, fades = false;
  Duration queue{};  // of the link, as time at its rate; zero: the queue of the plan
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
  double bulk_kbps = 0.0;         // arrived
  std::size_t states = 0;         // arrived
  std::size_t looks_without = 0;  // samples before the first arrival
  double link_late_p99_ms = 0.0;  // deliveries of the emulator: the delay added by the machine
};

// One row for each stream, in order of first arrival; one row without a name if nothing arrived.
Result<std::vector<ComparisonRow>, Problem> run_comparison(const Peer& contestant,
                                                           const ComparisonCase& of_case,
                                                           const ComparisonPlan& plan);

// The link of each direction; its fades count from the start of the run.
link::LinkParams link_of(const ComparisonCase& of_case, const ComparisonPlan& plan);

// Lower bound of the age on this channel: a value of zero size each millisecond, lost only in
// fades. No protocol can be better.
ComparisonRow best_possible(const ComparisonCase& of_case, const ComparisonPlan& plan);

// Output of a base, in order of arrival.
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

// Figures of one stream from its arrivals, the bulk and the offered load. A pure function; times
// count from the start of the link.
ComparisonRow judge(const Arrivals& arrivals, const LinkTally& tally, const ComparisonPlan& plan);

}  // namespace pitwall::benchmarks

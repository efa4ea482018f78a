// Input of a report: the event log of a run, read back, and the figures of its result file.
//   in     bytes of an event log (hil/bench/run_record.hpp); text of a result file
//          (bench::to_json(RunResult)), or none
//   out    RunData; times are seconds since the start of the run
//   errors none: each fault of the log or of the result is a sentence in `infrastructure`, and
//          everything readable is there
//   cost   O(bytes)
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "hil/bench/result.hpp"
#include "hil/bench/run_record.hpp"
#include "hil/report/match_table.hpp"
#include "protocol/recording/mcap_reader.hpp"
#include "protocol/vocabulary/units.hpp"

namespace pitwall::report {

struct Facts {
  std::string scenario, seed, mode, source, database, revision, fingerprint, bus, track_file;
  double duration_s = kUnset;  // as the scenario states it
};

template <class S>
struct At {
  double t_s = 0.0;
  S v{};
};

struct BusFrame {
  std::uint8_t from = 0;  // bench::Node
  std::uint32_t id = 0;
  std::uint16_t bits = 0;  // on the wire, with stuff bits
};

struct Event {
  std::string name, text;
};

struct FaultSpan {
  std::string kind;
  double from_s = 0.0, to_s = kUnset;  // NaN: until the end of the run
  std::uint32_t can_id = 0;
};

struct VerdictRow {
  std::string text, place, reason;
  bool pass = false;
  double margin = kUnset, first_violation_s = kUnset;  // margin is NaN if there is no number
};

// Contact of the car with another one; NaN where the log has no such value.
struct ContactRow {
  struct Car {
    double x_m = kUnset, y_m = kUnset, yaw_rad = kUnset;
    double speed_mps = kUnset, n_m = kUnset, length_m = kUnset, width_m = kUnset;
  };
  double t_s = kUnset, s_m = kUnset, x_m = kUnset, y_m = kUnset, closing_mps = kUnset;
  std::string with, kind, rule;
  double with_number = kUnset;
  bool is_caused = false, is_caused_by_other = false;
  Car own{}, other{};
};

// From the result file; NaN if the file has no such value.
struct ResultFigures {
  std::string refused_to_arm;
  std::string ending;  // where the car was at the end
  double laps = kUnset, flying = kUnset, best_flying_s = kUnset, best_flying_mean_mps = kUnset;
  double speed_max_mps = kUnset;
  double to_car = kUnset, from_car = kUnset, lost = kUnset, bus_losses = kUnset;
  double gate_refusals = kUnset, bus_refusals = kUnset;
  std::optional<bench::RealTime> real_time;
  std::vector<std::string> remarks;  // further notes for the reader
  std::optional<MatchRows> match;    // of a passing competition
};

struct LogHealth {
  std::uint64_t bytes = 0, read_bytes = 0;
  recording::McapEnd end = recording::McapEnd::kReading;
  recording::McapReaderCounters counters;
  std::uint64_t missing = 0;      // messages missing by the sequence numbers of their channel
  std::uint64_t undecodable = 0;  // messages that do not fit the schema of their channel
};

// kContact: the car hit a wall, and the scenario does not name that contact, or it caused a contact
// with another car.
enum class Outcome : std::uint8_t { kPass, kFail, kInfrastructure, kContact };

struct RunData {
  Facts facts;
  std::vector<At<bench::TruthSample>> truth;
  std::vector<At<bench::CarSample>> car;  // empty: not recorded
  std::vector<At<bench::OtherSample>> others;
  std::vector<At<BusFrame>> can;
  std::vector<At<bench::LossSample>> losses;
  std::vector<At<Event>> events;  // all except verdicts
  std::vector<FaultSpan> faults;
  std::vector<VerdictRow> verdicts;   // with those of the result for other cars with a stack
  std::optional<ContactRow> contact;  // with another car
  std::optional<ResultFigures> result;
  std::string digest;  // SHA-256 of the log
  LogHealth health;
  std::vector<std::string> infrastructure;  // why the verdicts cannot be relied on

  Outcome outcome() const;
  double end_s() const;  // latest time of everything recorded and planned
};

// `log_name` and `result_name` are for messages.
RunData read_run(std::span<const std::uint8_t> log, const std::string& log_name);
// Refuses a result that belongs to another run.
void add_result(RunData& run, std::string_view json, const std::string& result_name);

const char* name_of(Outcome outcome);  // "PASS" ...

}  // namespace pitwall::report

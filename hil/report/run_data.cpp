// SPDX-License-Identifier: Apache-2.0
#include "hil/report/run_data.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>

#include "hil/bench/contact.hpp"
#include "hil/can_bus/frame_length.hpp"
#include "hil/report/text.hpp"
#include "protocol/bits/sha256.hpp"
#include "protocol/json/json_value.hpp"
#include "protocol/vocabulary/text.hpp"

namespace pitwall::report {
namespace {

using json::JsonValue;
using recording::McapEnd;

VerdictRow row_of(const JsonValue& verdict, bool pass) {
  return {.text = verdict.text("text"),
          .place = verdict.text("place"),
          .reason = verdict.text("reason"),
          .pass = pass,
          .margin = verdict.number("margin"),
          .first_violation_s = verdict.number("first_violation_s")};
}

class LogReading {
 public:
  explicit LogReading(std::span<const std::uint8_t> log) : reader_(log) {}

  RunData read() {
    while (const auto message = reader_.next()) take(*message);
    take_facts();
    data_.health.end = reader_.end();
    data_.health.read_bytes = reader_.place();
    data_.health.counters = reader_.counters();
    return std::move(data_);
  }

 private:
  void take(const recording::McapMessage& message) {
    count_missing(message);
    const recording::Channel& channel = reader_.channels().at(message.channel);
    const double t_s = static_cast<double>(message.logged_ns) * 1e-9;
    const bool taken = channel.topic == "/truth"        ? keep(channel, message, t_s, data_.truth)
                       : channel.topic == "/car"        ? keep(channel, message, t_s, data_.car)
                       : channel.topic == "/others"     ? keep(channel, message, t_s, data_.others)
                       : channel.topic == "/bus_losses" ? keep(channel, message, t_s, data_.losses)
                       : channel.topic == "/can"        ? keep_frame(channel, message, t_s)
                       : channel.topic == "/events"     ? keep_event(message, t_s)
                                                        : true;
    if (!taken) ++data_.health.undecodable;
  }

  // The writer numbers the messages of a channel from 0 on.
  void count_missing(const recording::McapMessage& message) {
    std::uint32_t& due = due_[message.channel];
    if (message.sequence > due) data_.health.missing += message.sequence - due;
    due = message.sequence + 1;
  }

  template <class S>
  static bool read_sample(const recording::Channel& channel, const recording::McapMessage& message,
                          S& sample) {
    static const recording::Schema kSchema = recording::cdr_schema<S>();
    return channel.schema == kSchema && recording::from_cdr(message.data, sample);
  }

  template <class S>
  static bool keep(const recording::Channel& channel, const recording::McapMessage& message,
                   double t_s, std::vector<At<S>>& rows) {
    S sample{};
    if (!read_sample(channel, message, sample)) return false;
    rows.push_back({t_s, sample});
    return true;
  }

  bool keep_frame(const recording::Channel& channel, const recording::McapMessage& message,
                  double t_s) {
    bench::CanSample sample;
    if (!read_sample(channel, message, sample)) return false;
    can::Frame frame;
    frame.id = sample.id;
    frame.extended = sample.id > can::kMaxStandardId;
    if (sample.id > can::kMaxExtendedId || sample.data.size() > 8) return false;
    frame.length = static_cast<std::uint8_t>(sample.data.size());
    std::copy(sample.data.begin(), sample.data.end(), frame.data.begin());
    const auto bits = static_cast<std::uint16_t>(can_bus::frame_length(frame).bits);
    data_.can.push_back({t_s, {sample.from, sample.id, bits}});
    return true;
  }

  bool keep_event(const recording::McapMessage& message, double t_s) {
    const std::string_view text{reinterpret_cast<const char*>(message.data.data()),
                                message.data.size()};
    const auto json = JsonValue::parse(text, "event");
    if (!json || !json->is_object()) return false;
    Event event{json->text("name"), json->text("text")};
    if (event.name == "contact") take_contact(event);
    if (event.name == "pass" || event.name == "fail") {
      data_.verdicts.push_back(verdict_of(event));
    } else {
      data_.events.push_back({t_s, std::move(event)});
    }
    return true;
  }

  // One with a wall is a sentence, one with a car an object with that sentence in it.
  void take_contact(Event& event) {
    const auto json = JsonValue::parse(event.text, "contact");
    if (!json || !json->is_object()) return;
    event.text = json->text("text");
    data_.contact = contact_of(*json);
  }

  static ContactRow contact_of(const JsonValue& json) {
    const auto car = [&json](const char* key) {
      ContactRow::Car out;
      if (const JsonValue* v = json.find(key))
        out = {.x_m = v->number("x_m"),
               .y_m = v->number("y_m"),
               .yaw_rad = v->number("yaw_rad"),
               .speed_mps = v->number("speed_mps"),
               .n_m = v->number("n_m"),
               .length_m = v->number("length_m"),
               .width_m = v->number("width_m")};
      return out;
    };
    return {.t_s = json.number("at_s"),
            .s_m = json.number("s_m"),
            .x_m = json.number("x_m"),
            .y_m = json.number("y_m"),
            .closing_mps = json.number("closing_mps"),
            .with = json.text("with"),
            .kind = json.text("kind"),
            .rule = json.text("rule"),
            .with_number = json.number("with_number"),
            .is_caused = json.flag("caused"),
            .is_caused_by_other = json.flag("caused_by_other"),
            .own = car("own"),
            .other = car("other")};
  }

  static VerdictRow verdict_of(const Event& event) {
    const auto json = JsonValue::parse(event.text, "verdict");
    if (!json || !json->is_object())
      return {.text = event.text, .place = {}, .reason = {}, .pass = event.name == "pass"};
    return row_of(*json, event.name == "pass");
  }

  void take_facts() {
    std::map<std::string, std::string> run;
    for (const auto& [key, value] : reader_.run()) run.try_emplace(key, value);
    data_.facts = {.scenario = run["scenario"],
                   .seed = run["seed"],
                   .mode = run["mode"],
                   .source = run["source"],
                   .database = run["database"],
                   .revision = run["revision"],
                   .fingerprint = run["fingerprint"],
                   .bus = run["bus"],
                   .track_file = run["track_file"]};
    if (run.contains("duration_s"))
      data_.facts.duration_s = std::strtod(run["duration_s"].c_str(), nullptr);
    if (const auto faults = JsonValue::parse(run["faults"], "faults"))
      for (const JsonValue& fault : faults->items())
        if (std::isfinite(fault.number("at_s"))) data_.faults.push_back(fault_of(fault));
  }

  static FaultSpan fault_of(const JsonValue& fault) {
    FaultSpan span{.kind = fault.text("kind"), .from_s = fault.number("at_s")};
    if (const double lasts_s = fault.number("lasts_s"); lasts_s > 0.0)
      span.to_s = span.from_s + lasts_s;
    if (const double id = fault.number("can_id"); id > 0.0 && id <= can::kMaxExtendedId)
      span.can_id = static_cast<std::uint32_t>(id);
    return span;
  }

  recording::McapReader reader_;
  RunData data_;
  std::map<std::uint16_t, std::uint32_t> due_;
};

unsigned long long wide(std::uint64_t value) { return value; }

void judge_log(RunData& run, const std::string& name) {
  const LogHealth& log = run.health;
  const auto complain = [&](const std::string& what) {
    run.infrastructure.push_back(name + ": " + what);
  };
  if (log.end != McapEnd::kComplete)
    complain(formatted("%s at byte %llu of %llu; %llu messages were read before that",
                       recording::to_string(log.end), wide(log.read_bytes), wide(log.bytes),
                       wide(log.counters.messages)));
  if (const std::uint64_t bad = log.counters.bad_chunk_crc + log.counters.compressed_chunks)
    complain(
        formatted("%llu of %llu chunks could not be read", wide(bad), wide(log.counters.chunks)));
  if (log.counters.bad_data_crc + log.counters.bad_summary_crc > 0)
    complain("a checksum of the file is wrong: something was changed after it was written");
  if (log.missing > 0) complain(formatted("%llu messages are missing", wide(log.missing)));
  if (log.undecodable + log.counters.unknown_channel > 0)
    complain(formatted("%llu messages are not what their channel says, or of another version",
                       wide(log.undecodable + log.counters.unknown_channel)));
  if (log.end == McapEnd::kComplete && run.truth.empty())
    complain("holds no truth of a plant: not the log of a run, or nothing was simulated");
}

std::optional<transport::ClockWaits> waits_of(const JsonValue* json) {
  if (json == nullptr || !(json->number("count") >= 0.0)) return std::nullopt;
  return transport::ClockWaits{.count = static_cast<std::uint64_t>(json->number("count")),
                               .total = from_seconds(json->number("total_ms") * 1e-3),
                               .longest = from_seconds(json->number("longest_ms") * 1e-3),
                               .longest_at = Instant{} + from_seconds(json->number("longest_at_s")),
                               .longest_for = json->text("longest_for")};
}

std::optional<bench::RealTime> real_time_of(const JsonValue* json) {
  if (json == nullptr) return std::nullopt;
  bench::RealTime t{.wake_late_p50_us = json->number("wake_late_p50_us"),
                    .wake_late_p99_us = json->number("wake_late_p99_us"),
                    .wake_late_max_us = json->number("wake_late_max_us"),
                    .waits = waits_of(json->find("waits")),
                    .stolen_ms = json->number("stolen_ms"),
                    .wake_late = {},
                    .step_p50_us = json->number("step_p50_us"),
                    .step_p99_us = json->number("step_p99_us"),
                    .step_max_us = json->number("step_max_us")};
  const auto count = [](double value) {
    return value > 0.0 && value < 1e15 ? static_cast<std::uint64_t>(value) : 0;
  };
  t.caught_up_wakes = count(json->number("caught_up_wakes"));
  t.missed_deadlines = count(json->number("missed_deadlines"));
  for (const JsonValue& bin : json->items("wake_late"))
    if (t.wake_late.size() < bench::RealTime::kWakeBins) t.wake_late.push_back(count(bin.number()));
  return t;
}

ResultFigures figures_of(const JsonValue& json) {
  static const JsonValue kNone;
  const auto inner = [&json](const char* key) -> const JsonValue& {
    const JsonValue* found = json.find(key);
    return found != nullptr ? *found : kNone;
  };
  ResultFigures figures{.refused_to_arm = json.text("refused_to_arm"),
                        .ending = inner("outcome").text("text"),
                        .laps = inner("laps").number("finished"),
                        .flying = inner("laps").number("flying"),
                        .best_flying_s = inner("laps").number("best_flying_s"),
                        .best_flying_mean_mps = inner("laps").number("best_flying_mean_mps"),
                        .speed_max_mps = json.number("speed_max_mps"),
                        .to_car = inner("can").number("to_car"),
                        .from_car = inner("can").number("from_car"),
                        .lost = inner("can").number("lost"),
                        .bus_losses = json.number("bus_losses"),
                        .gate_refusals = json.number("gate_refusals"),
                        .bus_refusals = json.number("bus_refusals"),
                        .real_time = real_time_of(json.find("real_time")),
                        .remarks = {},
                        .match = match_of(json)};
  for (const JsonValue& remark : json.items("remarks")) figures.remarks.push_back(remark.text());
  return figures;
}

// Another car has an event log of its own: here are its verdicts and its end.
void add_other(RunData& run, const JsonValue& other) {
  const std::string name = other.text("car") + ": ";
  for (const JsonValue& verdict : other.items("verdicts")) {
    run.verdicts.push_back(row_of(verdict, verdict.flag("pass")));
    run.verdicts.back().text = name + run.verdicts.back().text;
  }
  std::vector<std::string>& remarks = run.result->remarks;
  const JsonValue* const outcome = other.find("outcome");
  if (outcome != nullptr && !outcome->text("text").empty())
    remarks.push_back(name + outcome->text("text"));
  for (const JsonValue& remark : other.items("remarks")) remarks.push_back(name + remark.text());
}

template <class S>
void sort_by_time(std::vector<At<S>>& rows) {
  std::ranges::stable_sort(rows, {}, &At<S>::t_s);
}

template <class S>
double last_of(const std::vector<At<S>>& rows) {
  return rows.empty() ? 0.0 : rows.back().t_s;
}

}  // namespace

Outcome RunData::outcome() const {
  if (!infrastructure.empty()) return Outcome::kInfrastructure;
  const bool is_contact = std::ranges::any_of(verdicts, [](const VerdictRow& verdict) {
    return !verdict.pass &&
           (verdict.place == bench::kContactVerdict || verdict.place == bench::kCarContactVerdict);
  });
  if (is_contact) return Outcome::kContact;
  return std::ranges::all_of(verdicts, &VerdictRow::pass) ? Outcome::kPass : Outcome::kFail;
}

double RunData::end_s() const {
  const double planned_s = std::isfinite(facts.duration_s) ? facts.duration_s : 0.0;
  return std::max({planned_s, last_of(truth), last_of(car), last_of(can), 1e-3});
}

RunData read_run(std::span<const std::uint8_t> log, const std::string& log_name) {
  RunData run = LogReading{log}.read();
  sort_by_time(run.truth);
  sort_by_time(run.car);
  sort_by_time(run.others);
  sort_by_time(run.can);
  sort_by_time(run.losses);
  sort_by_time(run.events);
  run.health.bytes = log.size();
  bits::Sha256 hash;
  hash.update(log);
  run.digest = bits::to_hex(hash.digest());
  judge_log(run, log_name);
  return run;
}

void add_result(RunData& run, std::string_view text, const std::string& result_name) {
  const auto json = JsonValue::parse(text, result_name);
  if (!json) return run.infrastructure.push_back(to_string(json.error()));
  if (json->text("sha256") != run.digest)
    return run.infrastructure.push_back(result_name + ": is the result of another event log");
  run.result = figures_of(*json);
  const bool is_of_log = json->items("verdicts").size() == run.verdicts.size();
  for (const JsonValue& other : json->items("others")) add_other(run, other);
  const bool all_passed = std::ranges::all_of(run.verdicts, &VerdictRow::pass);
  if (!is_of_log || json->flag("passed") != all_passed)
    run.infrastructure.push_back(result_name + ": its verdicts are not those of the event log");
  for (const JsonValue& reason : json->items("not_judged"))
    run.infrastructure.push_back(result_name + ": not judged: " + reason.text());
}

const char* name_of(Outcome outcome) {
  switch (outcome) {
    case Outcome::kPass:
      return "PASS";
    case Outcome::kFail:
      return "FAIL";
    case Outcome::kInfrastructure:
      return "INFRASTRUCTURE";
    case Outcome::kContact:
      return "CONTACT";
  }
  return "?";
}

}  // namespace pitwall::report

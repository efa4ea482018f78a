// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/result.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string_view>

#include "hil/bench/contact.hpp"
#include "protocol/json/json_text.hpp"

namespace pitwall::bench {
namespace {

template <class... Args>
std::string format(const char* pattern, Args... args) {
  std::string text(256, '\0');
  const int length = std::snprintf(text.data(), text.size(), pattern, args...);
  CHECK(length >= 0);
  text.resize(std::min(static_cast<std::size_t>(length), text.size() - 1));
  return text;
}

std::string brackets_json(const grading::CrossTrack& cross) {
  std::string out = "[";
  for (std::size_t i = 0; i < grading::kBrackets.size(); ++i) {
    const grading::ErrorStatistics& row = cross.by_bracket[i];
    out += (i == 0 ? "" : ",") + std::string("{\"from_mps\":") +
           json::number(grading::kBrackets[i].from_mps) +
           ",\"samples\":" + std::to_string(row.samples) +
           ",\"mean_m\":" + json::number(row.mean_m()) + ",\"max_m\":" + json::number(row.max_m) +
           ",\"paper_best_m\":" + json::number(grading::kBrackets[i].paper_best_m) +
           ",\"paper_mean_m\":" + json::number(grading::kBrackets[i].paper_mean_m) + "}";
  }
  return out + "]";
}

std::string verdicts_json(const std::vector<grading::Verdict>& verdicts) {
  std::string out = "[";
  for (std::size_t i = 0; i < verdicts.size(); ++i)
    out += (i == 0 ? "" : ",") + to_json(verdicts[i]);
  return out + "]";
}

// The longest is told on the scenario's clock.
std::string waits_json(const std::optional<transport::ClockWaits>& waits) {
  if (!waits) return "null";
  return "{\"count\":" + std::to_string(waits->count) +
         ",\"total_ms\":" + json::number(waits->total.milliseconds()) +
         ",\"longest_ms\":" + json::number(waits->longest.milliseconds()) +
         ",\"longest_at_s\":" + json::number(waits->longest_at.seconds()) +
         ",\"longest_for\":" + json::quoted(waits->longest_for) + "}";
}

std::string real_time_json(const RealTime& t) {
  std::string bins;
  for (const std::uint64_t count : t.wake_late)
    bins += (bins.empty() ? "" : ",") + std::to_string(count);
  return "{\"wake_late_p50_us\":" + json::number(t.wake_late_p50_us) +
         ",\"wake_late_p99_us\":" + json::number(t.wake_late_p99_us) +
         ",\"wake_late_max_us\":" + json::number(t.wake_late_max_us) +
         ",\"caught_up_wakes\":" + std::to_string(t.caught_up_wakes) +
         ",\"behind_max_ms\":" + json::number(t.behind_max.milliseconds()) +
         ",\"waits\":" + waits_json(t.waits) + ",\"stolen_ms\":" + json::number(t.stolen_ms) +
         ",\"wake_late_bin_us\":" + json::number(RealTime::kWakeBin_us) + ",\"wake_late\":[" +
         bins + "],\"step_p50_us\":" + json::number(t.step_p50_us) +
         ",\"step_p99_us\":" + json::number(t.step_p99_us) +
         ",\"step_max_us\":" + json::number(t.step_max_us) +
         ",\"missed_deadlines\":" + std::to_string(t.missed_deadlines) + "}";
}

std::string done_json(const std::vector<Done>& done) {
  std::string out = "[";
  for (std::size_t i = 0; i < done.size(); ++i)
    out += (i == 0 ? "" : ",") + std::string("{\"at_s\":") + json::number(done[i].at.seconds()) +
           ",\"what\":" + json::quoted(done[i].what) + "}";
  return out + "]";
}

std::string remarks_json(const std::vector<std::string>& remarks) {
  std::string out = "[";
  for (std::size_t i = 0; i < remarks.size(); ++i)
    out += (i == 0 ? "" : ",") + json::quoted(remarks[i]);
  return out + "]";
}

}  // namespace

bool RunResult::passed() const {
  for (const grading::Verdict& verdict : verdicts)
    if (!verdict.pass) return false;
  return true;
}

bool RunResult::failed_by_contact() const {
  return std::ranges::any_of(verdicts, [](const grading::Verdict& verdict) {
    return verdict.name == kContactVerdict && !verdict.pass;
  });
}

std::string to_text(const RunResult& r) {
  std::string out = format("SIMULATION %s, %s: %.1f s simulated", r.scenario.c_str(),
                           r.mode.c_str(), r.simulated_s);
  if (std::isfinite(r.wall_s))
    out += format(" in %.2f s (%.1f x real time)", r.wall_s, r.simulated_s / r.wall_s);
  out += "\n\n" + grading::to_table(r.cross_track) + "\n";
  out += format("laps %u, flying %u", r.laps.finished, r.laps.flying);
  if (r.laps.flying > 0)
    out += format(", best flying lap %.3f s, mean %.2f m/s (%.1f mph)", r.laps.best_flying_s,
                  r.laps.best_flying_mean_mps, to_mph(r.laps.best_flying_mean_mps));
  out += format("; top speed %.2f m/s\n", r.speed_max_mps);
  if (const std::string end = to_text(r.outcome); !end.empty()) out += end + "\n";
  out += format("CAN frames: %llu to the car, %llu from the car, %llu lost",
                static_cast<unsigned long long>(r.traffic.to_car),
                static_cast<unsigned long long>(r.traffic.from_car),
                static_cast<unsigned long long>(r.traffic.lost));
  if (std::isfinite(r.traffic.bus_load))
    out += format(", bus load %.1f %%", 100.0 * r.traffic.bus_load);
  out += format(
      "\nrefused: %llu frames by the gateway, %llu commands by the frame gate; missed by the "
      "car when they were due: %llu frames\n",
      static_cast<unsigned long long>(r.bus_refusals),
      static_cast<unsigned long long>(r.gate_refusals),
      static_cast<unsigned long long>(r.bus_losses));
  if (!r.refused_to_arm.empty()) out += "car refused to arm: " + r.refused_to_arm + "\n";
  for (const Done& done : r.done)
    out += format("at %.3f s: ", done.at.seconds()) + done.what + "\n";
  for (const std::string& remark : r.remarks) out += "note: " + remark + "\n";
  for (const grading::Verdict& verdict : r.verdicts)
    out += (verdict.pass ? "PASS  " : "FAIL  ") + verdict.text +
           format("  (margin %.4g)", verdict.margin) +
           (verdict.delay ? format("  after %.3f s", verdict.delay->seconds()) : std::string()) +
           (verdict.pass ? "" : "  " + verdict.reason) + "\n";
  if (!r.digest.empty()) out += "event log SHA-256 " + r.digest + "\n";
  if (r.failed_by_contact()) return out + "verdict: CONTACT\n";
  return out + (r.passed() ? "verdict: PASS\n" : "verdict: FAIL\n");
}

std::string to_json(const Outcome& outcome) {
  const auto place = [](const Whereabouts& w) {
    return "{\"at_s\":" + json::number(w.at.seconds()) +
           ",\"speed_mps\":" + json::number(w.speed_mps) +
           ",\"cross_track_m\":" + json::number(w.cross_track_m) +
           ",\"wall_gap_m\":" + json::number(w.wall_gap_m) + ",\"s_m\":" + json::number(w.s_m) +
           "}";
  };
  if (!outcome.last) return "null";
  return "{\"text\":" + json::quoted(to_text(outcome)) +
         ",\"contact\":" + std::string(outcome.last->contact ? "true" : "false") +
         ",\"end\":" + place(*outcome.last) + ",\"nearest_wall\":" + place(*outcome.nearest) + "}";
}

std::string to_json(const grading::Verdict& v) {
  const double first_s = v.first_violation ? (*v.first_violation - Instant{}).seconds() : kUnset;
  return "{\"text\":" + json::quoted(v.text) + ",\"pass\":" + (v.pass ? "true" : "false") +
         ",\"margin\":" + json::number(v.margin) +
         ",\"first_violation_s\":" + json::number(first_s) +
         ",\"time_left_s\":" + json::number(v.time_left ? v.time_left->seconds() : kUnset) +
         ",\"delay_s\":" + json::number(v.delay ? v.delay->seconds() : kUnset) +
         ",\"place\":" + json::quoted(v.name) + ",\"reason\":" + json::quoted(v.reason) + "}";
}

std::string to_json(const RunResult& r) {
  return "{\"scenario\":" + json::quoted(r.scenario) + ",\"mode\":" + json::quoted(r.mode) +
         ",\"simulation\":true,\"passed\":" + (r.passed() ? "true" : "false") +
         ",\"failed_by_contact\":" + (r.failed_by_contact() ? "true" : "false") +
         ",\"timely\":" + (r.timely() ? "true" : "false") +
         ",\"simulated_s\":" + json::number(r.simulated_s) +
         ",\"wall_s\":" + json::number(r.wall_s) +
         ",\"laps\":{\"finished\":" + std::to_string(r.laps.finished) +
         ",\"flying\":" + std::to_string(r.laps.flying) +
         ",\"best_flying_s\":" + json::number(r.laps.best_flying_s) +
         ",\"best_flying_mean_mps\":" + json::number(r.laps.best_flying_mean_mps) + "}" +
         ",\"speed_max_mps\":" + json::number(r.speed_max_mps) +
         ",\"outcome\":" + to_json(r.outcome) +
         ",\"cross_track_overall_m\":" + json::number(r.cross_track.overall.mean_m()) +
         ",\"cross_track_max_m\":" + json::number(r.cross_track.overall.max_m) +
         ",\"cross_track\":" + brackets_json(r.cross_track) +
         ",\"can\":{\"to_car\":" + std::to_string(r.traffic.to_car) +
         ",\"from_car\":" + std::to_string(r.traffic.from_car) +
         ",\"car_received\":" + std::to_string(r.traffic.car_received) +
         ",\"bench_received\":" + std::to_string(r.traffic.bench_received) +
         ",\"lost\":" + std::to_string(r.traffic.lost) +
         ",\"bus_load\":" + json::number(r.traffic.bus_load) + "}" +
         ",\"gate_refusals\":" + std::to_string(r.gate_refusals) +
         ",\"bus_refusals\":" + std::to_string(r.bus_refusals) +
         ",\"bus_losses\":" + std::to_string(r.bus_losses) +
         (r.real_time ? ",\"real_time\":" + real_time_json(*r.real_time) : std::string()) +
         ",\"done\":" + done_json(r.done) + ",\"remarks\":" + remarks_json(r.remarks) +
         ",\"refused_to_arm\":" + json::quoted(r.refused_to_arm) +
         ",\"sha256\":" + json::quoted(r.digest) + ",\"verdicts\":" + verdicts_json(r.verdicts) +
         "}";
}

}  // namespace pitwall::bench

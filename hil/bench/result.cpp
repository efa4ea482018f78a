// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/result.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

#include "hil/bench/contact.hpp"
#include "protocol/json/json_text.hpp"
#include "protocol/vocabulary/check.hpp"
#include "protocol/vocabulary/text.hpp"

namespace pitwall::bench {
namespace {

std::string brackets_json(const grading::CrossTrack& cross) {
  json::Array out;
  for (std::size_t i = 0; i < grading::kBrackets.size(); ++i) {
    const grading::ErrorStatistics& row = cross.by_bracket[i];
    out.json(json::Object{}
                 .number("from_mps", grading::kBrackets[i].from_mps)
                 .number("samples", row.samples)
                 .number("mean_m", row.mean_m())
                 .number("max_m", row.max_m)
                 .number("paper_best_m", grading::kBrackets[i].paper_best_m)
                 .number("paper_mean_m", grading::kBrackets[i].paper_mean_m)
                 .str());
  }
  return out.str();
}

// By lap; the first up to the start line.
std::string lap_errors_json(const std::vector<grading::ErrorStatistics>& laps) {
  json::Array out;
  for (const grading::ErrorStatistics& lap : laps)
    out.json(json::Object{}
                 .number("samples", lap.samples)
                 .number("mean_m", lap.mean_m())
                 .number("max_m", lap.max_m)
                 .str());
  return out.str();
}

std::string feed_json(const SensorFeed& feed) {
  return json::Object{}
      .number("sent", feed.sent)
      .number("refused", feed.refused)
      .number("skipped", feed.skipped)
      .number("late_p50_ms", feed.late_p50_ms)
      .number("late_p99_ms", feed.late_p99_ms)
      .number("late_max_ms", feed.late_max_ms)
      .str();
}

std::string feed_text(const char* what, const SensorFeed& feed) {
  return formatted(
      "%s: %llu sent, %llu refused, %llu times skipped; late p50 %.1f ms, p99 %.1f ms, at most "
      "%.1f ms\n",
      what, static_cast<unsigned long long>(feed.sent),
      static_cast<unsigned long long>(feed.refused), static_cast<unsigned long long>(feed.skipped),
      feed.late_p50_ms, feed.late_p99_ms, feed.late_max_ms);
}

std::string laps_json(const decltype(RunResult::laps)& laps) {
  return json::Object{}
      .number("finished", laps.finished)
      .number("flying", laps.flying)
      .number("best_flying_s", laps.best_flying_s)
      .number("best_flying_mean_mps", laps.best_flying_mean_mps)
      .str();
}

std::string traffic_json(const decltype(RunResult::traffic)& traffic) {
  return json::Object{}
      .number("to_car", traffic.to_car)
      .number("from_car", traffic.from_car)
      .number("car_received", traffic.car_received)
      .number("bench_received", traffic.bench_received)
      .number("lost", traffic.lost)
      .number("bus_load", traffic.bus_load)
      .str();
}

std::string verdicts_json(const std::vector<grading::Verdict>& verdicts) {
  json::Array out;
  for (const grading::Verdict& verdict : verdicts) out.json(to_json(verdict));
  return out.str();
}

// The longest is told on the scenario's clock.
std::string waits_json(const std::optional<transport::ClockWaits>& waits) {
  if (!waits) return "null";
  return json::Object{}
      .number("count", waits->count)
      .number("total_ms", waits->total.milliseconds())
      .number("longest_ms", waits->longest.milliseconds())
      .number("longest_at_s", waits->longest_at.seconds())
      .text("longest_for", waits->longest_for)
      .str();
}

std::string real_time_json(const RealTime& t) {
  json::Array bins;
  for (const std::uint64_t count : t.wake_late) bins.number(count);
  return json::Object{}
      .number("wake_late_p50_us", t.wake_late_p50_us)
      .number("wake_late_p99_us", t.wake_late_p99_us)
      .number("wake_late_max_us", t.wake_late_max_us)
      .number("caught_up_wakes", t.caught_up_wakes)
      .number("behind_max_ms", t.behind_max.milliseconds())
      .json("waits", waits_json(t.waits))
      .number("stolen_ms", t.stolen_ms)
      .number("wake_late_bin_us", RealTime::kWakeBin_us)
      .json("wake_late", bins.str())
      .number("step_p50_us", t.step_p50_us)
      .number("step_p99_us", t.step_p99_us)
      .number("step_max_us", t.step_max_us)
      .number("ticks", t.ticks)
      .number("missed_deadlines", t.missed_deadlines)
      .str();
}

std::string done_json(const std::vector<CompletedAction>& done) {
  json::Array out;
  for (const CompletedAction& one : done)
    out.json(json::Object{}.number("at_s", one.at.seconds()).text("what", one.what).str());
  return out.str();
}

std::string texts_json(const std::vector<std::string>& texts) {
  json::Array out;
  for (const std::string& text : texts) out.text(text);
  return out.str();
}

std::string match_text(const race::MatchSheet& sheet) {
  std::string out;
  for (std::size_t i = 0; i < sheet.attempts.size(); ++i) out += race::to_text(sheet, i) + "\n";
  return out + "match: " + race::result_text(sheet) + "\n";
}

bool has_failed_contact(const RunResult& result) {
  return std::ranges::any_of(result.verdicts, [](const grading::Verdict& verdict) {
    return (verdict.name == kContactVerdict || verdict.name == kCarContactVerdict) && !verdict.pass;
  });
}

void add_missed(const RunResult& result, std::vector<std::string>& reasons) {
  if (!result.real_time || result.real_time->missed_share() <= RealTime::kMissedShareMax) return;
  const RealTime& t = *result.real_time;
  reasons.push_back((result.car.empty() ? "the car" : "car " + result.car) +
                    formatted(" missed %.2f %% of its ticks (%llu of %llu), more than %.0f %%",
                              100.0 * t.missed_share(),
                              static_cast<unsigned long long>(t.missed_deadlines),
                              static_cast<unsigned long long>(t.ticks + t.missed_deadlines),
                              100.0 * RealTime::kMissedShareMax));
}

// One car: laps, end, traffic, refusals, verdicts.
std::string drive_text(const RunResult& r) {
  std::string out = formatted("laps %u, flying %u", r.laps.finished, r.laps.flying);
  if (r.laps.flying > 0)
    out += formatted(", best flying lap %.3f s, mean %.2f m/s (%.1f mph)", r.laps.best_flying_s,
                     r.laps.best_flying_mean_mps, to_mph(r.laps.best_flying_mean_mps));
  out += formatted("; top speed %.2f m/s\n", r.speed_max_mps);
  if (const std::string end = to_text(r.outcome); !end.empty()) out += end + "\n";
  if (r.car_contact) out += to_text(*r.car_contact) + "\n";
  if (r.match) out += match_text(*r.match);
  out += formatted("CAN frames: %llu to the car, %llu from the car, %llu lost",
                   static_cast<unsigned long long>(r.traffic.to_car),
                   static_cast<unsigned long long>(r.traffic.from_car),
                   static_cast<unsigned long long>(r.traffic.lost));
  if (std::isfinite(r.traffic.bus_load))
    out += formatted(", bus load %.1f %%", 100.0 * r.traffic.bus_load);
  out += formatted(
      "\nrefused: %llu frames by the gateway, %llu commands by the frame gate; missed by the "
      "car when they were due: %llu frames\n",
      static_cast<unsigned long long>(r.bus_refusals),
      static_cast<unsigned long long>(r.gate_refusals),
      static_cast<unsigned long long>(r.bus_losses));
  if (r.detections_lost > 0)
    out += formatted("frames of detections that never reached the car: %llu\n",
                     static_cast<unsigned long long>(r.detections_lost));
  if (r.sweeps_on_map + r.sweeps_by_cloth > 0)
    out += formatted("LiDARs, ray by ray: %llu sweeps on the ground of the map, %llu without\n",
                     static_cast<unsigned long long>(r.sweeps_on_map),
                     static_cast<unsigned long long>(r.sweeps_by_cloth));
  if (r.images > 0)
    out += formatted("cameras, rendered: %llu images\n", static_cast<unsigned long long>(r.images));
  if (r.clouds) out += feed_text("clouds of LiDARs", *r.clouds);
  if (r.live_images) out += feed_text("images of cameras", *r.live_images);
  if (!r.refused_to_arm.empty()) out += "car refused to arm: " + r.refused_to_arm + "\n";
  for (const CompletedAction& done : r.done)
    out += formatted("at %.3f s: ", done.at.seconds()) + done.what + "\n";
  for (const std::string& remark : r.remarks) out += "note: " + remark + "\n";
  for (const grading::Verdict& verdict : r.verdicts)
    out += (verdict.pass ? "PASS  " : "FAIL  ") + verdict.text +
           formatted("  (margin %.4g)", verdict.margin) +
           (verdict.delay ? formatted("  after %.3f s", verdict.delay->seconds()) : std::string()) +
           (verdict.pass ? "" : "  " + verdict.reason) + "\n";
  if (!r.digest.empty()) out += "event log SHA-256 " + r.digest + "\n";
  return out;
}

std::string others_json(const std::vector<RunResult>& others) {
  json::Array out;
  for (const RunResult& other : others) out.json(to_json(other));
  return out.str();
}

}  // namespace

double RealTime::missed_share() const {
  const auto all = static_cast<double>(ticks + missed_deadlines);
  return is_slowed || all == 0.0 ? 0.0 : static_cast<double>(missed_deadlines) / all;
}

bool RunResult::passed() const {
  return std::ranges::all_of(verdicts, &grading::Verdict::pass) &&
         std::ranges::all_of(others, &RunResult::passed);
}

bool RunResult::failed_by_contact() const {
  return has_failed_contact(*this) || std::ranges::any_of(others, has_failed_contact);
}

std::vector<std::string> RunResult::not_judged() const {
  std::vector<std::string> reasons;
  if (!timely() && !passed()) reasons.push_back(late_text(*real_time));
  add_missed(*this, reasons);
  for (const RunResult& other : others) add_missed(other, reasons);
  return reasons;
}

RunResult with_others(std::vector<RunResult> cars, std::span<const std::string> names) {
  CHECK(cars.size() == names.size() + 1);
  RunResult own = std::move(cars.front());
  for (std::size_t i = 0; i < names.size(); ++i) {
    own.others.push_back(std::move(cars[i + 1]));
    own.others.back().car = names[i];
  }
  return own;
}

std::string late_text(const RealTime& time) {
  return formatted(
      "the machine did not keep up: at %.2f s the bench was %.0f ms behind its clock, and "
      "the car had no bus for as long",
      time.behind_at.seconds(), time.behind_max.milliseconds());
}

std::string to_text(const RunResult& r) {
  std::string out = formatted("SIMULATION %s, %s: %.1f s simulated", r.scenario.c_str(),
                              r.mode.c_str(), r.simulated_s);
  if (std::isfinite(r.wall_s))
    out += formatted(" in %.2f s (%.1f x real time)", r.wall_s, r.simulated_s / r.wall_s);
  out +=
      r.match
          ? "\n\nthe car changes lines in a match: its error from its first one is not judged\n\n"
          : "\n\n" + grading::to_table(r.cross_track) + "\n";
  out += drive_text(r);
  for (const RunResult& other : r.others)
    out += "\ncar " + other.car + "\n" + drive_text(other) + "\n";
  const std::vector<std::string> reasons = r.not_judged();
  for (const std::string& reason : reasons) out += "not judged: " + reason + "\n";
  if (!reasons.empty()) return out + "verdict: NOT JUDGED\n";
  if (r.failed_by_contact()) return out + "verdict: CONTACT\n";
  return out + (r.passed() ? "verdict: PASS\n" : "verdict: FAIL\n");
}

std::string to_json(const CarContact& contact) {
  const auto car = [](const plant::CarPose& pose) {
    return json::Object{}
        .number("x_m", pose.x_m)
        .number("y_m", pose.y_m)
        .number("yaw_rad", pose.yaw_rad)
        .number("speed_mps", traffic::speed_mps(pose))
        .number("n_m", pose.n_m)
        .number("length_m", pose.length_m)
        .number("width_m", pose.width_m)
        .str();
  };
  return json::Object{}
      .text("text", to_text(contact))
      .number("at_s", contact.at.seconds())
      .number("s_m", contact.s_m)
      .number("x_m", contact.point_m.x)
      .number("y_m", contact.point_m.y)
      .text("with", contact.with)
      .number("with_number", contact.with_number)
      .text("kind", traffic::name_of(contact.kind))
      .text("rule", traffic::name_of(contact.rule))
      .number("closing_mps", contact.closing_mps)
      .flag("caused", contact.is_caused)
      .flag("caused_by_other", contact.is_caused_by_other)
      .json("own", car(contact.own))
      .json("other", car(contact.other))
      .str();
}

std::string to_json(const Outcome& outcome) {
  const auto place = [](const VehiclePlace& w) {
    return json::Object{}
        .number("at_s", w.at.seconds())
        .number("speed_mps", w.speed_mps)
        .number("cross_track_m", w.cross_track_m)
        .number("wall_gap_m", w.wall_gap_m)
        .number("s_m", w.s_m)
        .str();
  };
  if (!outcome.last) return "null";
  return json::Object{}
      .text("text", to_text(outcome))
      .flag("contact", outcome.last->contact)
      .json("end", place(*outcome.last))
      .json("nearest_wall", place(*outcome.nearest))
      .str();
}

std::string to_json(const grading::Verdict& v) {
  return json::Object{}
      .text("text", v.text)
      .flag("pass", v.pass)
      .number("margin", v.margin)
      .number("first_violation_s",
              v.first_violation ? (*v.first_violation - Instant{}).seconds() : kUnset)
      .number("time_left_s", v.time_left ? v.time_left->seconds() : kUnset)
      .number("delay_s", v.delay ? v.delay->seconds() : kUnset)
      .text("place", v.name)
      .text("reason", v.reason)
      .str();
}

std::string to_json(const RunResult& r) {
  json::Object out;
  out.text("scenario", r.scenario);
  if (!r.car.empty()) out.text("car", r.car);
  out.text("mode", r.mode)
      .flag("simulation", true)
      .flag("passed", r.passed())
      .flag("failed_by_contact", r.failed_by_contact())
      .flag("timely", r.timely())
      .json("not_judged", texts_json(r.not_judged()))
      .number("simulated_s", r.simulated_s)
      .number("wall_s", r.wall_s)
      .json("laps", laps_json(r.laps))
      .number("speed_max_mps", r.speed_max_mps)
      .json("outcome", to_json(r.outcome))
      .number("other_cars", r.other_cars)
      .json("car_contact", r.car_contact ? to_json(*r.car_contact) : "null")
      .number("cross_track_overall_m", r.cross_track.overall.mean_m())
      .number("cross_track_max_m", r.cross_track.overall.max_m)
      .json("cross_track", brackets_json(r.cross_track))
      .json("match", r.match ? race::to_json(*r.match) : "null")
      .json("cross_track_by_lap", lap_errors_json(r.cross_track.by_lap))
      .json("can", traffic_json(r.traffic))
      .number("gate_refusals", r.gate_refusals)
      .number("bus_refusals", r.bus_refusals)
      .number("bus_losses", r.bus_losses)
      .number("detections_lost", r.detections_lost)
      .number("images", r.images)
      .number("sweeps_on_map", r.sweeps_on_map)
      .number("sweeps_by_cloth", r.sweeps_by_cloth);
  if (r.clouds) out.json("clouds", feed_json(*r.clouds));
  if (r.live_images) out.json("live_images", feed_json(*r.live_images));
  if (r.real_time) out.json("real_time", real_time_json(*r.real_time));
  if (!r.others.empty()) out.json("others", others_json(r.others));
  return out.json("done", done_json(r.done))
      .json("remarks", texts_json(r.remarks))
      .text("refused_to_arm", r.refused_to_arm)
      .text("sha256", r.digest)
      .json("verdicts", verdicts_json(r.verdicts))
      .str();
}

}  // namespace pitwall::bench

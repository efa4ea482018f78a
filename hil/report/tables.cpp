// SPDX-License-Identifier: Apache-2.0
#include "hil/report/tables.hpp"

#include <algorithm>
#include <cmath>

#include "hil/report/absent.hpp"
#include "hil/report/html.hpp"
#include "hil/report/plot.hpp"
#include "hil/report/text.hpp"
#include "protocol/can/av21.hpp"
#include "protocol/vocabulary/text.hpp"

namespace pitwall::report {
namespace {

constexpr std::size_t kRowsMax = 400;  // of events and of losses; the rest is counted

std::string left_out(std::size_t rows) {
  return rows > kRowsMax
             ? formatted("<p class=\"note\">%zu more are in the log.</p>\n", rows - kRowsMax)
             : std::string();
}

std::string node_name(std::uint8_t node) {
  constexpr const char* kNames[]{"car", "drive-by-wire", "race control", "guardian"};
  return node < std::size(kNames) ? kNames[node] : "node " + std::to_string(node);
}

std::string milliseconds_text(double span_s) {
  return std::isfinite(span_s) ? number(1e3 * span_s, 2) : "&ndash;";
}

std::string message_row(const Intervals& m) {
  constexpr std::size_t kBins = 60;
  const double period_s = std::isfinite(m.nominal_s) ? m.nominal_s : m.quantile_s(0.5);
  std::string picture;
  if (!m.sorted_s.empty() && period_s > 0.0)
    picture = small_histogram(histogram(m.sorted_s, 0.0, 2.0 * period_s, kBins), 240.0, 20.0, 0.5);
  return "<tr>" + cell(formatted("%u", m.id)) +
         cell(m.name.empty() ? "<i>not in the database</i>" : escaped(m.name), "word") +
         cell(node_name(m.from), "word") + cell(std::to_string(m.frames)) +
         cell(milliseconds_text(m.nominal_s)) + cell(milliseconds_text(m.quantile_s(0.5))) +
         cell(milliseconds_text(m.quantile_s(0.01))) + cell(milliseconds_text(m.quantile_s(0.99))) +
         cell(milliseconds_text(m.quantile_s(1.0))) + cell(picture) + "</tr>\n";
}

std::string detector_name(std::uint8_t detector) {
  constexpr const char* kNames[]{"counter", "period", "socket queue", "interface"};
  return detector < std::size(kNames) ? kNames[detector] : "number " + std::to_string(detector);
}

void count_verdicts(const RunData& run, std::size_t& passed, std::size_t& all) {
  all = run.verdicts.size();
  passed = static_cast<std::size_t>(std::ranges::count_if(run.verdicts, &VerdictRow::pass));
}

}  // namespace

std::string header(const RunData& run) {
  const Facts& f = run.facts;
  const bool simulated = f.source == "simulation";
  return "<header><p class=\"simulation\">" +
         std::string(simulated ? kSimulated : "source not recorded") + "</p><h1>" +
         escaped(f.scenario.empty() ? "run without a name" : f.scenario) + "</h1>\n<dl>" +
         fact("mode", f.mode) + fact("seed", f.seed) +
         fact("duration", std::isfinite(f.duration_s) ? number(f.duration_s, 1) + " s" : "") +
         fact("CAN database", f.database + " " + f.revision) + fact("fingerprint", f.fingerprint) +
         fact("bus spoke", f.bus) + fact("track file", f.track_file) +
         fact("event log, SHA-256", run.digest) + "</dl></header>\n";
}

std::string banner(const RunData& run) {
  std::size_t passed = 0, all = 0;
  count_verdicts(run, passed, all);
  const Outcome outcome = run.outcome();
  std::string words = all == 0 ? "no expectation was judged"
                               : formatted("%zu of %zu expectations held", passed, all);
  if (outcome == Outcome::kInfrastructure) words = "the bench or its log failed; " + words;
  constexpr const char* kStyles[]{"pass", "fail", "infrastructure", "fail"};
  std::string out = formatted("<section class=\"banner %s\" id=\"verdict\"><strong>",
                              kStyles[static_cast<std::size_t>(outcome)]) +
                    name_of(outcome) + "</strong> " + words;
  if (run.result && !run.result->ending.empty())
    out += "<p>" + escaped(run.result->ending) + "</p>";
  for (const std::string& reason : run.infrastructure) out += "<p>" + escaped(reason) + "</p>";
  if (run.result && !run.result->refused_to_arm.empty())
    out += "<p>The car refused to arm: " + escaped(run.result->refused_to_arm) + "</p>";
  if (run.result)
    for (const std::string& remark : run.result->remarks)
      out += "<p>Note: " + escaped(remark) + "</p>";
  return out + "</section>\n";
}

std::string verdict_table(const RunData& run) {
  if (run.verdicts.empty()) return absent("verdicts", "Expectations", "no verdict in the log");
  std::string out =
      "<table class=\"verdicts\"><thead><tr><th></th><th>expectation</th><th>margin</th>"
      "<th>first violated</th><th>why</th></tr></thead><tbody>";
  for (const VerdictRow& v : run.verdicts) {
    const std::string first =
        std::isfinite(v.first_violation_s) ? number(v.first_violation_s, 2) + " s" : "&ndash;";
    const std::string margin = std::isfinite(v.margin) ? significant(v.margin, 4) : "&ndash;";
    out +=
        std::string("<tr class=\"") + (v.pass ? "held" : "broken") + "\">" +
        cell(v.pass ? "held" : "VIOLATED", "state") +
        cell(escaped(v.text) + (v.place.empty() ? "" : " <small>" + escaped(v.place) + "</small>"),
             "word") +
        cell(margin) + cell(first) + cell(escaped(v.reason), "word") + "</tr>\n";
  }
  return out + "</tbody></table>\n";
}

std::string figures_table(const RunData& run) {
  std::string out = "<dl class=\"figures\">";
  const auto add = [&out](const std::string& name, double value, int decimals, const char* unit) {
    if (std::isfinite(value))
      out += "<div><dt>" + name + "</dt><dd>" + number(value, decimals) + unit + "</dd></div>";
  };
  if (run.result) {
    const ResultFigures& r = *run.result;
    add("laps", r.laps, 0, "");
    add("flying laps", r.flying, 0, "");
    if (r.flying > 0) add("best flying lap", r.best_flying_s, 3, " s");
    if (r.flying > 0) add("its mean speed", r.best_flying_mean_mps, 2, " m/s");
    add("top speed", r.speed_max_mps, 2, " m/s");
    add("CAN frames to the car", r.to_car, 0, "");
    add("CAN frames from the car", r.from_car, 0, "");
    add("frames lost", r.lost, 0, "");
    add("frames that the car missed", r.bus_losses, 0, "");
    add("refused by the gateway", r.bus_refusals, 0, "");
    add("refused by the frame gate", r.gate_refusals, 0, "");
  }
  add("messages in the log", static_cast<double>(run.health.counters.messages), 0, "");
  add("of these without checksum", static_cast<double>(run.health.counters.unverified), 0, "");
  add("bytes of the log", static_cast<double>(run.health.bytes), 0, "");
  add("bytes not read", static_cast<double>(run.health.bytes - run.health.read_bytes), 0, "");
  out += "</dl>\n";
  if (!run.result)
    out += absent("result", "Laps, traffic and refusals", "no result file was given, only the log");
  return out;
}

std::string message_table(const RunData& run) {
  const auto messages = intervals_of(run.can);
  if (messages.empty())
    return absent("messages", "Timing of messages", "no CAN frame was recorded");
  std::string out =
      "<table class=\"numbers messages\"><thead><tr><th>id</th><th>message</th><th>from</th>"
      "<th>frames</th><th>period, ms</th><th>median</th><th>p1</th><th>p99</th><th>longest</th>"
      "<th>intervals: 0 to 2 periods, log count</th></tr></thead><tbody>";
  const bool same = run.facts.fingerprint ==
                    formatted("%016llx", static_cast<unsigned long long>(can::av21::kFingerprint));
  for (const Intervals& message : messages) out += message_row(message);
  out += "</tbody></table>\n";
  if (!same)
    out +=
        "<p class=\"note\">Names and periods are those of this build's database, which is not "
        "that of the run.</p>\n";
  return out;
}

// Nothing where there is nothing to blame on it.
std::string stolen(const bench::RealTime& t) {
  if (!(t.stolen_ms > 0.0)) return {};
  return " The host of this virtual machine took " + number(t.stolen_ms, 0) +
         " ms of its processors' time.";
}

std::string stood(const bench::RealTime& t) {
  if (!t.waits) return " Time was that of the wall clock.";
  std::string out = " Bench time stood " + std::to_string(t.waits->count) +
                    " times for the machine, " + number(t.waits->total.seconds(), 2) + " s in all";
  if (t.waits->count == 0) return out + ".";
  const std::string& who = t.waits->longest_for;
  return out + ", at the longest " + number(t.waits->longest.milliseconds(), 0) + " ms at " +
         number(t.waits->longest_at.seconds(), 2) + " s for " +
         (who.empty() ? "the bench" : escaped(who)) + ".";
}

std::string real_time_charts(const RunData& run) {
  if (run.facts.mode == "lockstep")
    return absent("wake", "Lateness of the bench", "time is virtual in lockstep");
  if (!run.result || !run.result->real_time)
    return absent("wake", "Lateness of the bench", "not in the result of this run");
  const bench::RealTime& t = *run.result->real_time;
  std::string out = "<p>Bench: wake-ups late by " + number(t.wake_late_p50_us, 0) + " us (p50), " +
                    number(t.wake_late_p99_us, 0) + " us (p99), " + number(t.wake_late_max_us, 0) +
                    " us at most; " + std::to_string(t.caught_up_wakes) +
                    " began more than one wake-up late." + stolen(t) + " Car: a step took " +
                    number(t.step_p50_us, 0) + " us (p50), " + number(t.step_p99_us, 0) +
                    " us (p99), " + number(t.step_max_us, 0) + " us at most; " +
                    std::to_string(t.missed_deadlines) + " deadlines missed." + stood(t) + "</p>\n";
  std::vector<Bar> bars;
  Line heights{{0.0, 0.0}};
  double last_us = bench::RealTime::kWakeBin_us;
  for (std::size_t i = 0; i < t.wake_late.size(); ++i) {
    if (t.wake_late[i] == 0) continue;
    const double from_us = bench::RealTime::kWakeBin_us * static_cast<double>(i);
    last_us = from_us + bench::RealTime::kWakeBin_us;
    bars.push_back({from_us, last_us, std::log10(1.0 + static_cast<double>(t.wake_late[i]))});
    heights.push_back({last_us, bars.back().value});
  }
  if (bars.empty()) return out + absent("wake", "Lateness of the bench", "no wake-up was measured");
  Plot plot("wake", "Lateness of the bench's wake-ups", Plot::Kind::kBars, {1200.0, 220.0},
            {0.0, last_us, "late by, us (the last bin holds all later ones)"},
            axis_over({{heights}}, "log10(1 + count)", 1.0));
  plot.bars(bars, {.colour = kBlue, .name = "wake-ups", .unit = "log10(1 + count)"});
  return out + plot.svg();
}

std::string event_table(const RunData& run) {
  const std::vector<At<Event>>& events = run.events;
  if (events.empty()) return absent("events", "Events", "none in the log");
  std::string out =
      "<table><thead><tr><th>time, s</th><th>event</th><th>what</th></tr></thead><tbody>";
  for (std::size_t i = 0; i < std::min(events.size(), kRowsMax); ++i) {
    const auto& [t_s, event] = events[i];
    out += "<tr>" + cell(number(t_s, 2)) + cell(escaped(event.name), "word") +
           cell(escaped(event.text), "word") + "</tr>\n";
  }
  return out + "</tbody></table>\n" + left_out(events.size());
}

std::string loss_table(const RunData& run) {
  if (run.losses.empty()) return absent("losses", "Losses on the bus", "the car noticed none");
  std::string out =
      "<table><thead><tr><th>noticed, s</th><th>id</th><th>frames</th><th>due, s</th>"
      "<th>noticed by</th></tr></thead><tbody>";
  for (std::size_t i = 0; i < std::min(run.losses.size(), kRowsMax); ++i) {
    const auto& [t_s, loss] = run.losses[i];
    out += "<tr>" + cell(number(t_s, 3)) + cell(loss.id == 0 ? "any" : std::to_string(loss.id)) +
           cell(std::to_string(loss.frames)) +
           cell(loss.due_s > 0.0 ? number(loss.due_s, 3) : "&ndash;") +
           cell(detector_name(loss.detector), "word") + "</tr>\n";
  }
  return out + "</tbody></table>\n" + left_out(run.losses.size());
}

}  // namespace pitwall::report

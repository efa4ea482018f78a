// SPDX-License-Identifier: Apache-2.0
#include "basestation/publishers/text/link_text.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "basestation/state/event_text.hpp"
#include "basestation/state/station_field.hpp"
#include "protocol/vocabulary/text.hpp"

namespace pitwall::publishers {
namespace {

using telemetry::field;
using telemetry::LinkReport;

constexpr double kBitsPerByte = 8.0, kPerKilo = 1e-3, kPercent = 100.0;
constexpr std::size_t kLogLines = 4, kPlaces = 3;

unsigned long long count(std::uint64_t n) { return n; }

std::string known_ms(const std::optional<Duration>& duration) {
  return duration ? formatted("%.1f ms", duration->milliseconds()) : "not known";
}

TextLine head_line(const service::CarService& car, Instant now) {
  const link::PacketRate& rate = car.link().rate();
  if (!rate.ever()) return {"PITWALL   waiting for the first packet", Tone::kBold};
  if (rate.lost(now)) {
    return {formatted("PITWALL   CAR LOST: not heard for %.1f s; all below is as old as it says",
                      rate.since_last(now).seconds()),
            Tone::kAlarm};
  }
  if (car.link().source() != link::Station::Source::kCar) {
    return {"PITWALL   *** SIMULATION ***   no real car", Tone::kInverse};
  }
  return {"PITWALL   REAL CAR", Tone::kBold};
}

std::string link_line(const service::CarService& car, const LinkReport& report, Instant now) {
  const link::PacketRate& rate = car.link().rate();
  if (!rate.ever()) return "link      nothing received";
  std::string text = formatted(
      "link      session %llu   %.1f Hz   %llu packets, %llu lost (%.1f %%)   "
      "last %s ago   round trip %s   ",
      count(report.sessions), rate.rate_hz(now), count(rate.packets()),
      count(car.link().lost_packets()), kPercent * car.link().loss(),
      age_text(rate.since_last(now)).c_str(), known_ms(report.round_trip).c_str());
  text += car.link().endpoint().clock_known()
              ? formatted("clocks known to +-%s", known_ms(report.clock_bound).c_str())
              : std::string{"clocks NOT compared: ages lack the time on the way"};
  return text;
}

std::string address_text(const UdpAddress& address) {
  return address.known() ? to_string(address) : "no address";
}

// What the car told of this path, and how long ago.
std::string reported(const service::CarService& car, telemetry::PathId path, Instant now) {
  const state::FieldView radio = car.vehicle().group(telemetry::Group::kRadio, now);
  if (radio.quality == state::Quality::kNever) return "nothing received from the car";
  const bool second = path == 1;
  const auto part = [&](const char* name, telemetry::FieldIndex which, double factor,
                        const char* unit) {
    const state::FieldView view = car.vehicle().view(which, now);
    if (view.quality == state::Quality::kNever) return formatted("%s ?", name);
    const std::string text = formatted("%s %.0f%s", name, factor * view.value, unit);
    return view.age > radio.age ? text + " (" + age_text(view.age) + " ago)" : text;
  };
  return "the car reported " + age_text(radio.age) + " ago: " +
         part("loss", second ? field("radio.loss_1") : field("radio.loss_0"), kPercent, " %") +
         part(", one way", second ? field("radio.delay_1") : field("radio.delay_0"), 1.0, " ms") +
         part(", budget used", second ? field("radio.budget_use_1") : field("radio.budget_use_0"),
              kPercent, " %");
}

std::vector<TextLine> path_lines(const service::CarService& car, const LinkReport& report,
                                 telemetry::PathId path, Instant now) {
  const telemetry::PathReport& p = report.paths[path];
  const telemetry::PathFigures& h = p.received;
  std::vector<TextLine> lines;
  const std::string bursts = h.mean_bad.ns > 0
                                 ? formatted("bursts %.0f ms each %.1f s",
                                             h.mean_bad.milliseconds(), h.mean_good.seconds())
                                 : "no bursts yet";
  lines.push_back(
      {formatted("path %d    down %6.1f kbit/s   loss %.1f %% (%llu in all)   %s   "
                 "one way %.0f/%.0f/%.0f ms p50/95/99   jitter %.1f ms",
                 int{path}, h.rate_bytes_per_s * kBitsPerByte * kPerKilo, kPercent * h.loss,
                 count(h.lost), bursts.c_str(), h.delay_p50.milliseconds(),
                 h.delay_p95.milliseconds(), h.delay_p99.milliseconds(), h.jitter.milliseconds())});
  lines.push_back(
      {formatted("          up   %llu packets   budget used %.1f %% (x%.2f)   "
                 "no room %llu times   %s %s",
                 count(p.spent.packets), kPercent * p.budget_use, p.rate_factor,
                 count(p.spent.refused), address_text(p.peer).c_str(),
                 p.validated      ? "proved"
                 : p.peer.known() ? "not proved"
                                  : "")});
  lines.push_back({"          " + reported(car, path, now)});
  return lines;
}

std::string ages_line(const service::CarService& car) {
  constexpr std::array<std::pair<telemetry::Class, const char*>, telemetry::kClasses> kNames{
      {{telemetry::Class::kSafety, "safety"},
       {telemetry::Class::kMotion, "motion"},
       {telemetry::Class::kHealth, "health"},
       {telemetry::Class::kStatistics, "statistics"}}};
  std::string text = "ages      p50/p99/max ms";
  for (const auto& [priority, name] : kNames) {
    const link::AgeHistogram& ages = car.link().ages().of(priority);
    text += ages.empty()
                ? formatted("   %s -", name)
                : formatted("   %s %.0f/%.0f/%.0f", name, ages.quantile(0.50).milliseconds(),
                            ages.quantile(0.99).milliseconds(), ages.largest().milliseconds());
  }
  return text;
}

std::string refused_line(const LinkReport& report) {
  std::uint64_t total = report.bad_records;
  std::string kinds;
  const auto add = [&](const char* name, std::uint64_t n) {
    total += n;
    if (n > 0) kinds += formatted("   %s %llu", name, count(n));
  };
  for (std::size_t i = 0; i < telemetry::kRefusals; ++i) {
    const auto kind = static_cast<telemetry::Refusal>(i);
    std::uint64_t n = report.association.refused[i];
    if (kind == telemetry::Refusal::kReplayed) n -= report.association.duplicates;
    add(telemetry::text_of(kind), n);
  }
  for (std::size_t i = 0; i < telemetry::kBodyErrors; ++i) {
    add(telemetry::text_of(static_cast<telemetry::BodyError>(i)), report.bad_bodies[i]);
  }
  if (report.bad_records > 0) kinds += formatted("   bad records %llu", count(report.bad_records));
  if (report.association.duplicates > 0) {
    kinds += formatted("   (copies by the other path %llu)", count(report.association.duplicates));
  }
  return formatted("refused   %llu", count(total)) + kinds;
}

std::string label_of(const service::CarService& car, telemetry::FieldIndex which, Instant now) {
  const state::FieldView view = car.vehicle().view(which, now);
  if (view.quality == state::Quality::kNever) return "not received";
  const auto label = telemetry::label_at(telemetry::kFields[which].labels,
                                         static_cast<std::size_t>(view.value + 0.5));
  return std::string{label} + " (" + age_text(view.age) + " ago)";
}

TextLine stop_line(const service::CarService& car, Instant now) {
  const telemetry::StopState& asked = car.link().endpoint().stop().state();
  const state::FieldView latched = car.vehicle().view(field("mode.stop_latch"), now);
  const telemetry::HolderId holder = car.link().endpoint().authority().holder(now);
  const std::string console = holder == 0 ? "nobody" : formatted("console %u", unsigned{holder});
  const auto level =
      telemetry::label_at(telemetry::kStopLevels, static_cast<std::size_t>(asked.level));
  const bool stopped = asked.level != telemetry::StopLevel::kNone ||
                       (latched.quality != state::Quality::kNever && latched.value > 0.0);
  return {formatted("operator  stop asked: %s   latched by the car: %s   authority: %s",
                    std::string{level}.c_str(),
                    label_of(car, field("mode.stop_latch"), now).c_str(), console.c_str()),
          stopped ? Tone::kAlarm : Tone::kPlain};
}

void add_commands(const service::CarService& car, Instant now, std::vector<TextLine>& lines) {
  std::vector<telemetry::CommandProgress> commands;
  for (const command::Ticket& ticket : car.requests().queue().tickets())
    if (ticket.progress) commands.push_back(*ticket.progress);
  const std::size_t first = commands.size() - std::min(commands.size(), kLogLines);
  for (std::size_t i = first; i < commands.size(); ++i) {
    const telemetry::CommandProgress& c = commands[i];
    const bool refused = c.outcome && *c.outcome != telemetry::Outcome::kApplied;
    lines.push_back({formatted("command   %s ago   #%u %s: %s", age_text(now - c.issued).c_str(),
                               unsigned{c.id}, state::command_text(c.command).c_str(),
                               state::progress_text(c, now).c_str()),
                     refused ? Tone::kWarning : Tone::kPlain});
  }
  const auto& audit = car.requests().audit().lines();
  const auto refused = std::find_if(audit.rbegin(), audit.rend(), [](const auto& line) {
    return line.result.starts_with("refused");
  });
  if (refused == audit.rend()) return;
  lines.push_back({"operator  " + refused->who + ": " + refused->what + ": " + refused->result,
                   Tone::kWarning});
}

void add_events(const service::CarService& car, Instant now, std::vector<TextLine>& lines) {
  const auto& events = car.link().events();
  const std::size_t first = events.size() - std::min(events.size(), kLogLines);
  for (std::size_t i = first; i < events.size(); ++i) {
    lines.push_back({formatted("event     %s ago   %s", age_text(now - events[i].at).c_str(),
                               state::event_text(events[i]).c_str())});
  }
}

// The sections of the track where most was lost.
std::string place_line(const service::CarService& car) {
  std::vector<std::pair<double, std::size_t>> places;
  for (std::size_t bin = 0; bin < telemetry::kTrackBins; ++bin) {
    const double loss = car.link().endpoint().loss_at(bin);
    if (loss > 0.0) places.emplace_back(loss, bin);
  }
  if (places.empty()) return {};
  std::sort(places.rbegin(), places.rend());
  std::string text = "places    most lost";
  for (std::size_t i = 0; i < std::min(places.size(), kPlaces); ++i) {
    const double from_m = link::Station::kSection_m * static_cast<double>(places[i].second);
    text += formatted("   at %.0f m %.1f %%", from_m, kPercent * places[i].first);
  }
  return text;
}

// Attacks and key errors that are there now, and which end sees them.
void add_threats(const service::CarService& car, const LinkReport& report, Instant now,
                 std::vector<TextLine>& lines) {
  const state::FieldView reported = car.vehicle().view(field("radio.threats"), now);
  const telemetry::ThreatSet by_car =
      telemetry::threats_of(state::usable(reported) ? reported.value : kUnset);
  for (std::size_t i = 0; i < telemetry::kThreats; ++i) {
    const auto threat = static_cast<telemetry::Threat>(i);
    const std::size_t seen =
        (report.threats.has(threat) ? 1U : 0U) + (by_car.has(threat) ? 2U : 0U);
    if (seen == 0) continue;
    lines.push_back({formatted("attack    seen %s: %s",
                               std::string{telemetry::label_at(state::kSeenBy, seen)}.c_str(),
                               std::string{telemetry::describe(threat)}.c_str()),
                     Tone::kAlarm});
  }
}

// Whether both ends mean the same by the same bits.
void add_schema(const service::CarService& car, std::vector<TextLine>& lines) {
  if (!car.link().endpoint().peer() || car.link().endpoint().schema_agrees()) return;
  lines.push_back({"schema    THE CAR'S SAFETY FIELDS DIFFER: it will not arm", Tone::kAlarm});
  std::string rest = car.link().endpoint().schema_difference();
  while (!rest.empty()) {
    const std::size_t end = std::min(rest.find('\n'), rest.size());
    lines.push_back({"schema    " + rest.substr(0, end), Tone::kAlarm});
    rest.erase(0, std::min(end + 1, rest.size()));
  }
}

}  // namespace

std::string age_text(Duration age) {
  if (age < seconds(10)) return formatted("%.0f ms", age.milliseconds());
  return formatted("%.0f s", age.seconds());
}

std::vector<TextLine> link_lines(const service::CarService& car, Instant now) {
  const LinkReport report = car.link().report(now);
  std::vector<TextLine> lines{head_line(car, now), {link_line(car, report, now)}};
  for (telemetry::PathId path = 0; path < car.link().paths(); ++path) {
    for (TextLine& line : path_lines(car, report, path, now)) lines.push_back(std::move(line));
  }
  lines.push_back({ages_line(car)});
  lines.push_back({refused_line(report)});
  add_threats(car, report, now, lines);
  if (std::string places = place_line(car); !places.empty()) {
    lines.push_back({std::move(places)});
  }
  add_schema(car, lines);
  lines.push_back(stop_line(car, now));
  add_commands(car, now, lines);
  add_events(car, now, lines);
  return lines;
}

}  // namespace pitwall::publishers

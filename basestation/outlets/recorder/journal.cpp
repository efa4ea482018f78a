// SPDX-License-Identifier: Apache-2.0
#include "basestation/outlets/recorder/journal.hpp"

#include "basestation/outlets/log_text.hpp"
#include "protocol/json/json_text.hpp"
#include "protocol/telemetry/command/command_table.hpp"

namespace pitwall::recorder {
namespace {

constexpr std::int64_t kNanosecondsPerMillisecond = 1'000'000;

std::int64_t ms(Instant at) { return at.ns / kNanosecondsPerMillisecond; }

const char* mode_of(intake::Station::Source source) {
  if (source == intake::Station::Source::kNone) return "NONE";
  return source == intake::Station::Source::kCar ? "REAL" : "HIL";
}

std::string step_of(const telemetry::CommandProgress& progress) {
  if (progress.confirmed) return "confirmed";
  if (progress.fate) return std::string{telemetry::text_of(*progress.fate)};
  if (progress.received) return "received";
  return progress.sent ? "sent" : "issued";
}

double ms_or_unset(const std::optional<Duration>& duration) {
  return duration ? duration->milliseconds() : kUnset;
}

}  // namespace

void Journal::packet(const intake::Station& station, const telemetry::Arrival& arrival) {
  recorder_.state(station.endpoint().state(), arrival.groups, arrival.received);
}

void Journal::serve(intake::Station& station, Instant now) {
  if (texts_) {
    if (source_ != station.source()) tell_source(station.source(), now);
    tell_events(station);
    tell_commands(station, now);
    if (now >= link_at_) {
      tell_link(station, now);
      link_at_ = now + kLinkEvery;
    }
  }
  if (now < figures_at_) return;
  recorder_.text(Topic::kRecorder, now, json_of(recorder_.figures(), now));
  figures_at_ = now + kFiguresEvery;
}

void Journal::tell_source(intake::Station::Source source, Instant now) {
  source_ = source;
  recorder_.text(Topic::kHello, now,
                 json::Object{}
                     .text("type", "hello")
                     .text("mode", mode_of(source))
                     .number("time_ms", ms(now))
                     .str());
}

void Journal::tell_events(const intake::Station& station) {
  const std::uint64_t fresh = station.events_heard() - events_;
  events_ = station.events_heard();
  const auto& kept = station.events();
  const auto count = std::min<std::uint64_t>(fresh, kept.size());
  for (auto event = kept.end() - static_cast<std::ptrdiff_t>(count); event != kept.end(); ++event) {
    const std::string text = json::Object{}
                                 .text("type", "event")
                                 .number("time_ms", ms(event->at))
                                 .text("text", outlets::event_text(*event))
                                 .str();
    recorder_.text(Topic::kEvent, event->at, text);
  }
}

void Journal::tell_commands(const intake::Station& station, Instant now) {
  for (const telemetry::CommandProgress& progress : station.commands()) {
    const std::string step = step_of(progress);
    std::string& told = steps_[progress.id];
    if (told == step) continue;
    told = step;
    const std::string text = json::Object{}
                                 .text("type", "command")
                                 .number("ticket", progress.id)
                                 .text("name", telemetry::row_of(progress.command.type).name)
                                 .number("argument", progress.command.argument)
                                 .text("step", step)
                                 .number("time_ms", ms(now))
                                 .str();
    recorder_.text(Topic::kCommand, now, text);
  }
  while (steps_.size() > intake::Station::kLogged) steps_.erase(steps_.begin());
}

void Journal::tell_link(const intake::Station& station, Instant now) {
  const telemetry::LinkReport report = station.report(now);
  recorder_.text(Topic::kLink, now,
                 json::Object{}
                     .text("type", "link")
                     .number("time_ms", ms(now))
                     .flag("established", report.established)
                     .number("sessions", report.sessions)
                     .number("packets", station.rate().packets())
                     .number("loss", station.loss())
                     .number("rtt_ms", ms_or_unset(report.round_trip))
                     .number("clock_offset_ms", ms_or_unset(report.clock_offset))
                     .number("clock_bound_ms", ms_or_unset(report.clock_bound))
                     .str());
}

intake::Station::Overhearing teller_of_datagrams(Recorder& recorder) {
  return [&recorder](bool down, telemetry::PathId path, telemetry::Address other, Instant at,
                     std::span<const std::uint8_t> bytes) {
    recorder.datagram(down, at, {.path = path, .ip = other.ip, .port = other.port, .bytes = bytes});
  };
}

std::function<void(const telemetry::JoystickSample&, Instant)> teller_of_joystick(
    Recorder& recorder) {
  return [&recorder](const telemetry::JoystickSample& sample, Instant at) {
    recorder.text(Topic::kJoystick, at,
                  json::Object{}
                      .text("type", "joystick")
                      .number("time_ms", ms(at))
                      .number("throttle_cap", sample.throttle_cap)
                      .number("brake", sample.brake)
                      .str());
  };
}

}  // namespace pitwall::recorder

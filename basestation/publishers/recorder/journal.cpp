// SPDX-License-Identifier: Apache-2.0
#include "basestation/publishers/recorder/journal.hpp"

#include "protocol/json/json_text.hpp"

namespace pitwall::recorder {
namespace {

constexpr std::int64_t kNanosecondsPerMillisecond = 1'000'000;

std::int64_t ms(Instant at) { return at.ns / kNanosecondsPerMillisecond; }

}  // namespace

void Journal::packet(const service::CarService& car, const telemetry::Arrival& arrival) {
  recorder_.state(car.link().endpoint().state(), arrival.groups, arrival.received);
}

void Journal::publish(const service::CarService& /*car*/, Instant now) {
  if (now < figures_at_) return;
  recorder_.text(Topic::kRecorder, now, json_of(recorder_.figures(), now));
  figures_at_ = now + kFiguresEvery;
}

link::Station::Observer observer_of_datagrams(Recorder& recorder) {
  return [&recorder](bool down, telemetry::PathId path, UdpAddress other, Instant at,
                     std::span<const std::uint8_t> bytes) {
    recorder.datagram(down, at, {.path = path, .ip = other.ip, .port = other.port, .bytes = bytes});
  };
}

std::function<void(const telemetry::JoystickSample&, Instant)> observer_of_joystick(
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

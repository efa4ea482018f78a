// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/recorded/command_trace.hpp"

#include <string>
#include <utility>

#include "hil/bench/recorded/operator_texts.hpp"
#include "protocol/can/decode.hpp"
#include "vehicle/io/tick_inputs.hpp"

namespace pitwall::bench {
namespace {

using telemetry::field;

// Where the commands are in the database.
struct CommandPlace {
  const can::Message* message = nullptr;
  std::size_t signal = 0;
};
using CommandPlaces = std::array<CommandPlace, kActuators>;

Result<CommandPlaces, Problem> places_in(const can::Database& database) {
  CommandPlaces places;
  for (std::size_t i = 0; i < kActuators; ++i) {
    const auto [message_name, signal_name] = kCommandSignals[i];
    const can::Message* const message = database.find(message_name);
    const auto signal = message == nullptr ? std::nullopt : message->index_of(signal_name);
    if (!signal)
      return Unexpected{
          Problem{database.name, "has no " + std::string(message_name) + "." + signal_name.data()}};
    places[i] = {message, *signal};
  }
  return places;
}

class Tracer {
 public:
  explicit Tracer(const CommandPlaces& places) : places_(places) {}

  std::optional<Problem> add(const RecordedTick& tick) {
    if (trace_.ticks++ == 0) begun_ = tick.now;
    trace_.length = tick.now - begun_;
    if (const auto wrong = note_inputs(tick)) return wrong;
    if (!tick.sent.empty() && !trace_.first_frame) trace_.first_frame = trace_.length;
    for (const can::Frame& frame : tick.sent)
      if (const auto wrong = note_command(frame, tick.given.number)) return wrong;
    if (tick.state) note_mode(tick.state->values[field("mode.mode")]);
    return std::nullopt;
  }
  CommandTrace take() {
    trace_.operator_texts = std::move(texts_).take();
    return std::move(trace_);
  }

 private:
  std::optional<Problem> note_command(const can::Frame& frame, std::uint64_t tick) {
    for (std::size_t i = 0; i < kActuators; ++i) {
      const can::Message& message = *places_[i].message;
      if (frame.id != message.id || frame.extended != message.extended) continue;
      values_.resize(message.signals.size());
      if (!can::decode(message, frame, values_))
        return Problem{"tick " + std::to_string(tick), message.name + " cannot be decoded"};
      trace_.commands[i].push_back({trace_.length, values_[places_[i].signal]});
    }
    return std::nullopt;
  }

  void note_mode(double mode) {
    if (mode != mode || (!trace_.modes.empty() && trace_.modes.back().value == mode)) return;
    trace_.modes.push_back({trace_.length, mode});
  }

  std::optional<Problem> note_inputs(const RecordedTick& tick) {
    io::TickCommands commands;
    const auto in = io::inputs_of(tick.given, tick.now, {}, {}, commands);
    if (!in) return in.error();
    if (trace_.ticks == 1) trace_.armed_at_start = in->requests.arm;
    if (in->guardian.drives || in->guardian.stopped) ++trace_.others.guardian;
    const std::uint64_t troubles = troubles_of(in->link);
    const bool is_worse = in->link.controller > world::ControllerState::kActive;
    if (is_worse || troubles > troubles_) ++trace_.others.controller;
    troubles_ = troubles;
    if (in->operator_inputs.joystick) ++trace_.others.joystick;
    if (in->radio_at && in->now - *in->radio_at > kBaseSilence) ++trace_.others.silence;
    texts_.add(*in, trace_.length);
    return std::nullopt;
  }

  static std::uint64_t troubles_of(const world::LinkObservation& link) {
    return link.lost_in_socket + link.lost_in_interface + link.error_frames + link.restarts;
  }

  const CommandPlaces& places_;
  CommandTrace trace_;
  Instant begun_{};
  std::uint64_t troubles_ = 0;  // so far
  OperatorTexts texts_;
  std::vector<double> values_;
};

}  // namespace

Result<CommandTrace, Problem> trace_of(RecordedRun& run, const can::Database& database) {
  const auto places = places_in(database);
  if (!places) return Unexpected{places.error()};
  Tracer tracer{*places};
  while (true) {
    const auto tick = run.next();
    if (!tick) return Unexpected{tick.error()};
    if (!*tick) return tracer.take();
    if (const auto wrong = tracer.add(**tick)) return Unexpected{*wrong};
  }
}

}  // namespace pitwall::bench

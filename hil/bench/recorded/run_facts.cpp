// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/recorded/run_facts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "hil/bench/recorded/operator_texts.hpp"
#include "hil/bench/signals.hpp"
#include "protocol/vocabulary/units.hpp"
#include "vehicle/io/tick_inputs.hpp"

namespace pitwall::bench {
namespace {

using telemetry::field;

constexpr double kStanding_mps = 0.3;
constexpr std::array kTyreFields{
    field("tyres.temperature_front_left"), field("tyres.temperature_front_right"),
    field("tyres.temperature_rear_left"), field("tyres.temperature_rear_right")};

class Collector {
 public:
  explicit Collector(const pipeline::Setup& setup) : setup_(setup) {}

  std::optional<Problem> add(const RecordedTick& tick) {
    if (!begun_) begun_ = tick.now;
    if (tick.state) before_ = tick.state->values[field("mode.mode")];
    if (!zero_) {
      if (tick.received.empty()) return std::nullopt;
      zero_ = tick.received.front().at;
      facts_.first_frame = *zero_ - *begun_;
      facts_.modes.push_back({Duration{}, before_});
    }
    at_ = std::max(tick.now - *zero_, Duration{});
    if (!tick.received.empty()) facts_.length = at_;
    if (tick.state) note_state(tick.state->values);
    return note_inputs(tick);
  }

  Result<RunFacts, Problem> finish() && {
    if (!zero_) return Unexpected{Problem{"recording", "the car received no frame"}};
    if (!is_placed_)
      return Unexpected{
          Problem{"recording", "the car never knew its position, so the start is unknown"}};
    facts_.operator_texts = std::move(texts_).take();
    const auto is_after = [&](const auto& entry) { return entry.at > facts_.length; };
    std::erase_if(facts_.operator_texts, is_after);
    std::erase_if(facts_.modes, is_after);
    std::erase_if(facts_.flags, is_after);
    return std::move(facts_);
  }

 private:
  void note_state(const telemetry::Values& v) {
    note_start(v[field("track.station")], v[field("track.offset")], v[field("ego.vx")]);
    note_tyres(v);
    note_flags(v);
    const double mode = v[field("mode.mode")];
    if (std::isfinite(mode) && mode != facts_.modes.back().value)
      facts_.modes.push_back({at_, mode});
  }

  void note_start(double s_m, double n_m, double speed_mps) {
    if (!std::isfinite(s_m) || !std::isfinite(n_m) || !std::isfinite(speed_mps)) return;
    facts_.speed_max_mps = std::max(facts_.speed_max_mps, speed_mps);
    const double off_m = std::abs(n_m - line_offset_m(setup_, {s_m, n_m}));
    facts_.off_line_max_m = std::max(facts_.off_line_max_m, off_m);
    if (is_placed_) return;
    is_placed_ = true;
    const double start_mps = speed_mps < kStanding_mps ? 0.0 : speed_mps;
    const double s_start_m = setup_.track.wrap_station(s_m - start_mps * at_.seconds());
    facts_.start = {.known_at = at_, .s_m = s_start_m, .n_m = n_m, .speed_mps = start_mps};
  }

  void note_tyres(const telemetry::Values& v) {
    if (std::isfinite(facts_.tyres_c)) return;
    double sum_c = 0.0;
    for (const telemetry::FieldIndex tyre : kTyreFields) sum_c += v[tyre];
    facts_.tyres_c = sum_c / static_cast<double>(kTyreFields.size());
  }

  void note_flags(const telemetry::Values& v) {
    const double track = v[field("flags.track")], vehicle = v[field("flags.vehicle")];
    if (!std::isfinite(track) || !std::isfinite(vehicle)) return;
    const double target_mps = v[field("flags.round_target_speed")];
    scenario::FlagChange now{.at = at_,
                             .track = static_cast<world::TrackFlag>(track),
                             .vehicle = static_cast<world::VehicleFlag>(vehicle)};
    if (std::isfinite(target_mps)) now.round_target_speed_mph = std::round(to_mph(target_mps));
    const scenario::FlagChange last =
        facts_.flags.empty() ? scenario::FlagChange{} : facts_.flags.back();
    if (now.track != last.track || now.vehicle != last.vehicle ||
        now.round_target_speed_mph != last.round_target_speed_mph)
      facts_.flags.push_back(now);
  }

  std::optional<Problem> note_inputs(const RecordedTick& tick) {
    io::TickCommands commands;
    const auto in = io::inputs_of(tick.given, tick.now, {}, {}, commands);
    if (!in) return in.error();
    texts_.add(*in, at_);
    if (in->operator_inputs.joystick) ++facts_.joystick_ticks;
    if (in->guardian.drives) ++facts_.guardian_ticks;
    return std::nullopt;
  }

  const pipeline::Setup& setup_;
  RunFacts facts_;
  std::optional<Instant> begun_, zero_;
  Duration at_{};  // since zero
  double before_ = 0.0;
  bool is_placed_ = false;
  OperatorTexts texts_;
};

}  // namespace

Result<RunFacts, Problem> facts_of(RecordedRun& run, const pipeline::Setup& setup) {
  Collector collector{setup};
  while (true) {
    const auto tick = run.next();
    if (!tick) return Unexpected{tick.error()};
    if (!*tick) return std::move(collector).finish();
    if (const auto wrong = collector.add(**tick)) return Unexpected{*wrong};
  }
}

}  // namespace pitwall::bench

// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <numbers>

#include "vehicle/parameters/car_file.hpp"
#include "vehicle/parameters/filter_section.hpp"
#include "vehicle/parameters/range_reader.hpp"
#include "vehicle/parameters/stop_section.hpp"

namespace pitwall::parameters {
namespace {

localization::UnitParams read_unit(yaml::StrictMap map) {
  const auto arm = map.numbers("antenna_m", 3, 3, -5.0, 5.0);
  const auto imu = map.numbers("imu_m", 3, 3, -5.0, 5.0);
  return {.antenna = {arm[0], arm[1], arm[2]},
          .baseline_yaw_rad = from_deg(map.number("baseline_yaw_deg", -180.0, 180.0)),
          .baseline_m = map.number("baseline_m", 0.2, 5.0),
          .imu = {imu[0], imu[1], imu[2]}};
}

// What the unit is, of whoever hears it; may be left out.
world::ReceiverParams read_receiver(yaml::StrictMap map) {
  world::ReceiverParams receiver;
  const std::string name = map.text_or("receiver", std::string(world::name_of(receiver.kind)));
  const auto* kind = std::ranges::find(world::kReceiverKindNames, name);
  if (kind == world::kReceiverKindNames.end())
    map.fail("receiver", "\"" + name + "\" is not one of: novatel_oem7, vectornav");
  receiver.kind = static_cast<world::ReceiverKind>(kind - world::kReceiverKindNames.begin());
  receiver.least_delay =
      from_seconds(map.number_or("receiver_delay_s", receiver.least_delay.seconds(), 0.0, 0.05));
  return receiver;
}

planning::LineParams read_line(yaml::StrictMap map) {
  planning::LineParams line;
  if (map.has("bank")) {
    line.bank = map.text("bank");
    if (line.bank.empty()) map.fail("bank", "names no file");
    line.name = map.text("name");
    if (map.has("offset_m"))
      map.fail("offset_m", "a line of a bank is named: it has no offset from the reference line");
    line.offset_m = 0.0;
  } else {
    read_ranges(map, planning::kOffsetRanges, line);
  }
  read_ranges(map, planning::kLineRanges, line);
  line.friction = read_friction(map.map("friction"));
  return line;
}

control::Controller read_controller(yaml::StrictMap& map, const char* key) {
  const std::string name = map.text(key);
  const control::Controller controller = control::controller_named(name);
  if (controller.step != nullptr) return controller;
  std::string names;
  for (const control::Controller& c : control::kControllers)
    names += (names.empty() ? "" : ", ") + std::string(c.name);
  map.fail(key, "\"" + name + "\" is not one of: " + names);
}

control::LateralParams read_lateral(yaml::StrictMap map) {
  control::LateralParams lateral;
  std::vector<yaml::StrictMap> brackets = map.maps("brackets");
  if (brackets.size() != control::kSpeedBrackets)
    map.fail("brackets",
             "expected one entry per speed bracket: " + std::to_string(control::kSpeedBrackets));
  for (std::size_t i = 0; i < brackets.size(); ++i) {
    const double from_mps = brackets[i].number("from_mps", 0.0, 110.0);
    if (from_mps != control::kBracketFrom_mps[i])
      brackets[i].fail("from_mps", "expected the begin of this bracket: " +
                                       std::to_string(control::kBracketFrom_mps[i]) + " m/s");
    const auto q = brackets[i].numbers("q", 4, 4, 0.0, 1e6);
    std::copy(q.begin(), q.end(), lateral.weights[i].state.begin());
    lateral.weights[i].steering = brackets[i].number("r", 1e-6, 1e6);
  }
  read_ranges(map, control::kLateralRanges, lateral);
  return lateral;
}

control::LqrParams read_lqr_ff(yaml::StrictMap map) {
  control::LqrParams lqr;
  std::vector<yaml::StrictMap> speeds = map.maps("weights");
  if (speeds.size() != control::kLqrSpeeds)
    map.fail("weights", "expected one entry per speed: " + std::to_string(control::kLqrSpeeds));
  for (std::size_t i = 0; i < control::kLqrSpeeds; ++i) {
    if (speeds[i].number("at_mps", 0.0, 110.0) != control::kLqrSpeed_mps[i])
      speeds[i].fail("at_mps", "expected " + std::to_string(control::kLqrSpeed_mps[i]) + " m/s");
    read_ranges(speeds[i], control::kLqrWeightRanges, lqr.weights[i]);
  }
  read_ranges(map, control::kLqrRanges, lqr);
  return lqr;
}

control::LongitudinalParams read_longitudinal(yaml::StrictMap map) {
  control::LongitudinalParams l;
  read_ranges(map, control::kLongitudinalRanges, l);
  return l;
}

control::GearParams read_gear(yaml::StrictMap map) {
  control::GearParams gear;
  const auto up = map.numbers("up_above_mps", control::kGears - 1, control::kGears - 1, 1.0, 110.0);
  const auto down =
      map.numbers("down_below_mps", control::kGears - 1, control::kGears - 1, 0.5, 110.0);
  std::copy(up.begin(), up.end(), gear.up_above_mps.begin());
  std::copy(down.begin(), down.end(), gear.down_below_mps.begin());
  read_ranges(map, control::kGearRanges, gear);
  return gear;
}

}  // namespace

localization::Params read_localization(yaml::StrictMap map, world::Receivers& receivers) {
  localization::Params p;
  std::vector<yaml::StrictMap> units = map.maps("units");
  if (units.size() != world::kGnssUnits) map.fail("units", "expected one entry per GNSS unit: 2");
  for (std::size_t i = 0; i < units.size(); ++i) {
    p.units[i] = read_unit(units[i]);
    receivers[i] = read_receiver(units[i]);
  }
  p.filter = read_filter(map.map("filter"));
  p.checks = read_checks(map);
  p.priorities = read_priorities(map);
  read_ranges(map, localization::kRanges, p);
  return p;
}

planning::SpeedLaw read_speed_law(yaml::StrictMap& map) {
  const std::string name = map.text("speed_law");
  if (name == "paper") return planning::SpeedLaw::kPaper;
  if (name != "limited") map.fail("speed_law", "\"" + name + "\" is not one of: paper, limited");
  return planning::SpeedLaw::kLimited;
}

planning::PassLaw read_pass_law(yaml::StrictMap& map) {
  const std::string name = map.text_or("law", "committed");
  if (name == "paper") return planning::PassLaw::kPaper;
  if (name != "committed") map.fail("law", "\"" + name + "\" is not one of: committed, paper");
  return planning::PassLaw::kCommitted;
}

// The lines of a car whose own line is one of a bank have names, otherwise offsets.
planning::Passing read_passing(yaml::StrictMap map, const planning::LineParams& own) {
  planning::Passing p;
  p.pass.law = read_pass_law(map);
  read_ranges(map, planning::kPassRanges, p.pass);
  read_ranges(map, planning::kRivalRanges, p.pass.rival);
  for (yaml::StrictMap line : map.maps("lines")) {
    planning::OtherLine other;
    if (own.bank.empty())
      other.offset_m = line.number("offset_m", -30.0, 30.0);
    else
      other.name = line.text("name");
    p.lines.push_back(other);
  }
  return p;
}

planning::Params read_planning(yaml::StrictMap map) {
  planning::Params p;
  p.speed_law = read_speed_law(map);
  p.line = read_line(map.map("line"));
  read_ranges(map, planning::kRanges, p);
  read_ranges(map, planning::kPaceRanges, p.comfort);
  p.racing = p.comfort;
  if (map.has("racing")) {
    yaml::StrictMap racing = map.map("racing");
    read_ranges(racing, planning::kPaceRanges, p.racing);
  }
  read_stop_plan(map.map("stop"), p);
  if (map.has("passing")) p.passing = read_passing(map.map("passing"), p.line);
  return p;
}

control::Params read_control(yaml::StrictMap map) {
  control::Params p;
  yaml::StrictMap lateral = map.map("lateral");
  if (lateral.has("drive_law"))
    lateral.fail("drive_law",
                 "expected control.controller instead, for steering and speed together");
  p.controller = read_controller(map, "controller");
  p.lateral = read_lateral(lateral);
  p.lqr_ff = read_lqr_ff(map.map("lqr_ff"));
  yaml::StrictMap lap = map.map("lap");
  read_ranges(lap, control::kLapRanges, p.lap);
  p.longitudinal = read_longitudinal(map.map("longitudinal"));
  yaml::StrictMap speed = map.map("speed");
  read_ranges(speed, control::kSpeedLawRanges, p.speed);
  p.gear = read_gear(map.map("gear"));
  return p;
}

}  // namespace pitwall::parameters

// SPDX-License-Identifier: Apache-2.0
#include "hil/scenario/scenario.hpp"

#include <array>
#include <string_view>
#include <utility>

#include "hil/scenario/expect_section.hpp"
#include "protocol/yaml/strict_map.hpp"

namespace pitwall::scenario {
namespace {

using world::TrackFlag;
using world::VehicleFlag;

template <class T>
struct Named {
  std::string_view name;
  T value;
};

constexpr std::array kTrackFlags = {
    Named<TrackFlag>{"none", TrackFlag::kNone},
    Named<TrackFlag>{"red", TrackFlag::kRed},
    Named<TrackFlag>{"orange", TrackFlag::kOrange},
    Named<TrackFlag>{"yellow", TrackFlag::kYellow},
    Named<TrackFlag>{"green", TrackFlag::kGreen},
    Named<TrackFlag>{"waving_green", TrackFlag::kWavingGreen},
    Named<TrackFlag>{"chequered", TrackFlag::kChequered},
    Named<TrackFlag>{"unknown", TrackFlag::kUnknown},
};

constexpr std::array kVehicleFlags = {
    Named<VehicleFlag>{"none", VehicleFlag::kNone},
    Named<VehicleFlag>{"black", VehicleFlag::kBlackPitIn},
    Named<VehicleFlag>{"blue", VehicleFlag::kBlue},
    Named<VehicleFlag>{"stop", VehicleFlag::kStop},
    Named<VehicleFlag>{"purple", VehicleFlag::kPurpleEmergency},
    Named<VehicleFlag>{"engine_kill", VehicleFlag::kEngineKill},
    Named<VehicleFlag>{"orange", VehicleFlag::kOrangeStartEngine},
    Named<VehicleFlag>{"yellow", VehicleFlag::kYellow},
    Named<VehicleFlag>{"chequered", VehicleFlag::kChequered},
    Named<VehicleFlag>{"defender", VehicleFlag::kDefender},
    Named<VehicleFlag>{"attacker", VehicleFlag::kAttacker},
    Named<VehicleFlag>{"unknown", VehicleFlag::kUnknown},
};

constexpr std::array kBusRevisions = {
    Named<BusRevision>{"v14", BusRevision::kV14},
    Named<BusRevision>{"v9", BusRevision::kV9},
    Named<BusRevision>{"v12", BusRevision::kV12},
    Named<BusRevision>{"av24", BusRevision::kAv24},
    Named<BusRevision>{"v14_protected", BusRevision::kProtected},
};

constexpr std::array kLidarKinds = {
    Named<LidarKind>{"model", LidarKind::kModel},
    Named<LidarKind>{"measured", LidarKind::kMeasured},
    Named<LidarKind>{"rays", LidarKind::kRays},
    Named<LidarKind>{"rays_clusters", LidarKind::kRaysClusters},
};

constexpr std::array kCameraKinds = {
    Named<CameraKind>{"model", CameraKind::kModel},
    Named<CameraKind>{"rendered", CameraKind::kRendered},
};

constexpr std::array kReceiverKinds = {
    Named<world::ReceiverKind>{"novatel_oem7", world::ReceiverKind::kNovatelOem7},
    Named<world::ReceiverKind>{"vectornav", world::ReceiverKind::kVectorNav},
};

constexpr double kFastestImpact_mps = 100.0;

template <class T, std::size_t N>
T one_of(const yaml::StrictMap& map, const char* key, const std::string& word,
         const std::array<Named<T>, N>& table) {
  std::string legal;
  for (const Named<T>& row : table) {
    if (row.name == word) return row.value;
    legal += (legal.empty() ? "" : ", ") + std::string(row.name);
  }
  map.fail(key, "\"" + word + "\" is not one of: " + legal);
}

template <class T, std::size_t N>
T one_of(yaml::StrictMap& map, const char* key, const std::array<Named<T>, N>& table,
         std::string_view fallback = {}) {
  return one_of(map, key,
                fallback.empty() ? map.text(key) : map.text_or(key, std::string(fallback)), table);
}

template <class T, std::size_t N>
const char* word_of(const std::array<Named<T>, N>& table, T value) {
  for (const Named<T>& row : table)
    if (row.value == value) return row.name.data();
  return "?";
}

Duration time_at(yaml::StrictMap& map, const char* key, double fallback_s) {
  return from_seconds(map.number_or(key, fallback_s, 0.0, kLongest_s));
}

Start read_start(yaml::StrictMap map) {
  Start start;
  start.s_m = map.number_or("s_m", 0.0, 0.0, 100'000.0);
  start.n_m = map.number_or("n_m", 0.0, -50.0, 50.0);
  start.speed_mps = map.number_or("speed_mps", 0.0, 0.0, 90.0);
  if (map.has("fuel_l")) start.fuel_l = map.number("fuel_l", 0.2, 110.0);
  map.finish();
  return start;
}

std::array<world::ReceiverKind, world::kGnssUnits> read_receivers(yaml::StrictMap& map) {
  const auto words = map.texts("receivers", world::kGnssUnits, world::kGnssUnits);
  std::array<world::ReceiverKind, world::kGnssUnits> kinds{};
  for (std::size_t unit = 0; unit < kinds.size(); ++unit)
    kinds[unit] = one_of(map, "receivers", words[unit], kReceiverKinds);
  return kinds;
}

Tyres read_tyres(yaml::StrictMap map) {
  Tyres tyres;
  tyres.temperature_c = map.number("temperature_c", kColdest_c, kHottest_c);
  map.finish();
  return tyres;
}

Perturbations read_perturbations(yaml::StrictMap map) {
  constexpr double kDelayMax_s = 0.5;
  const auto delay_s = [&map](const char* key) {
    return map.number_or(key, 0.0, 0.0, kDelayMax_s);
  };
  Perturbations p;
  p.mass_kg = map.number_or("mass_kg", 0.0, -300.0, 300.0);
  p.tyre_stiffness = map.number_or("tyre_stiffness", 1.0, 0.5, 2.0);
  p.friction = map.number_or("friction", 1.0, 0.2, 1.5);
  p.bank_error_rad = from_deg(map.number_or("bank_error_deg", 0.0, -5.0, 5.0));
  p.detection_noise = map.number_or("detection_noise", 1.0, 0.2, 5.0);
  p.consumption = map.number_or("consumption", 1.0, 0.5, 2.0);
  p.consumption_spread = map.number_or("consumption_spread", 0.0, 0.0, 0.5);
  p.wind_mps = map.number_or("wind_mps", 0.0, 0.0, 40.0);
  p.wind_to_rad = from_deg(map.number_or("wind_to_deg", 0.0, -360.0, 360.0));
  if (map.has("wind_to_deg") && !map.has("wind_mps")) map.fail("wind_to_deg", "needs wind_mps too");
  p.steering_delay_s = delay_s("steering_delay_s");
  p.throttle_delay_s = delay_s("throttle_delay_s");
  p.brake_delay_s = delay_s("brake_delay_s");
  p.gear_delay_s = delay_s("gear_delay_s");
  map.finish();
  return p;
}

FlagChange read_flag_change(yaml::StrictMap& map) {
  FlagChange change;
  change.at = from_seconds(map.number("at_s", 0.0, kLongest_s));
  change.track = one_of(map, "track", kTrackFlags);
  change.vehicle = one_of(map, "vehicle", kVehicleFlags, "none");
  change.round_target_speed_mph = map.number_or("round_target_speed_mph", 0.0, 0.0, 200.0);
  map.finish();
  return change;
}

Fault read_fault(yaml::StrictMap& map) {
  Fault fault;
  fault.place = map.place("kind");
  fault.kind = map.text("kind");
  fault.at = from_seconds(map.number("at_s", 0.0, kLongest_s));
  fault.lasts = time_at(map, "for_s", kLongest_s);
  fault.can_id = static_cast<std::uint32_t>(map.integer_or("can_id", 0, 0, 2047));
  fault.unit = static_cast<std::uint32_t>(map.integer_or("unit", 0, 0, 7));
  if (map.has("value")) fault.value = map.number("value", -1e9, 1e9);
  map.finish();
  return fault;
}

template <class T, class Read>
void read_list(yaml::StrictMap& map, const char* key, std::vector<T>& out, Read read_one) {
  if (!map.has(key)) return;
  std::vector<yaml::StrictMap> entries = map.maps(key);
  if (entries.size() > kMaxListed) map.fail(key, "more than 256 entries");
  for (yaml::StrictMap& entry : entries) out.push_back(read_one(entry));
}

void check_order(yaml::StrictMap& map, const Scenario& scenario) {
  for (std::size_t i = 1; i < scenario.race_control.size(); ++i)
    if (scenario.race_control[i].at <= scenario.race_control[i - 1].at)
      map.fail("race_control",
               "entry " + std::to_string(i + 1) + " is not later than the one before");
  if (scenario.match && !scenario.race_control.empty() &&
      scenario.race_control.back().at >= scenario.match->begins)
    map.fail("race_control", "has an entry after match.begins_s: from then on the judge calls");
  if (scenario.race_control.empty())
    map.fail("race_control", "expected at least one entry: race control would be silent");
}

NamedContact read_contact(yaml::StrictMap& map) {
  NamedContact contact{.at_most_mps = map.number("at_most_mps", 0.1, kFastestImpact_mps),
                       .reason = map.text("reason")};
  if (contact.reason.empty())
    map.fail("reason", "expected the reason why the contact cannot be avoided");
  map.finish();
  return contact;
}

Scenario read_root(yaml::StrictMap& map) {
  Scenario scenario;
  if (map.integer("schema", 0, 1000) != 1) map.fail("schema", "this bench reads schema 1");
  scenario.name = map.text("name");
  scenario.seed = static_cast<std::uint64_t>(map.integer("seed", 0, kMaxSeed));
  scenario.duration = from_seconds(map.number("duration_s", 0.1, kLongest_s));
  scenario.track_file = map.text("track");
  scenario.car_file = map.text("car");
  scenario.bus = one_of(map, "bus", kBusRevisions, "v14");
  scenario.lidars = one_of(map, "lidars", kLidarKinds, "model");
  scenario.cameras = one_of(map, "cameras", kCameraKinds, "model");
  if (map.has("receivers")) scenario.receivers = read_receivers(map);
  if (auto start = map.optional_map("start")) scenario.start = read_start(*start);
  if (auto tyres = map.optional_map("tyres")) scenario.tyres = read_tyres(*tyres);
  if (map.has("plant")) scenario.plant_file = map.text("plant");
  if (map.has("plant") && scenario.plant_file.empty()) map.fail("plant", "names no file");
  if (auto perturb = map.optional_map("perturb")) scenario.perturb = read_perturbations(*perturb);
  scenario.cars = read_cars(map, scenario.seed);
  scenario.match = read_match(map, scenario.cars);
  read_list(map, "race_control", scenario.race_control, read_flag_change);
  scenario.radio = read_radio(map);
  scenario.operator_texts = read_operator(map);
  read_list(map, "faults", scenario.faults, read_fault);
  std::vector<Instant> faults;
  for (const Fault& fault : scenario.faults) faults.push_back(Instant{} + fault.at);
  read_list(map, "expect", scenario.expect,
            [&faults](yaml::StrictMap& entry) { return read_expectation(entry, faults); });
  if (auto contact = map.optional_map("contact")) scenario.contact = read_contact(*contact);
  check_order(map, scenario);
  map.finish();
  return scenario;
}

}  // namespace

Result<Scenario, Problem> read_scenario(const std::string& text, const std::string& name) {
  const auto document = yaml::load_text(text, name);
  if (!document) return Unexpected{document.error()};
  return yaml::read(*document, [](yaml::StrictMap& map) { return read_root(map); });
}

const char* name_of(world::TrackFlag flag) { return word_of(kTrackFlags, flag); }
const char* name_of(world::VehicleFlag flag) { return word_of(kVehicleFlags, flag); }
const char* name_of(BusRevision revision) { return word_of(kBusRevisions, revision); }
const char* name_of(LidarKind lidars) { return word_of(kLidarKinds, lidars); }

}  // namespace pitwall::scenario

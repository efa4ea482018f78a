// Scenario file of one bench run: track, car, flags of race control, faults, expectations. Strict
// YAML: an unknown key, a wrong kind or a value out of range is an error with its line, and nothing
// is started.
//   in     text of a scenario file, its name for messages
//   out    Scenario; times are seconds of scenario time
//   errors Problem with file:line:column
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "hil/grading/expectation.hpp"
#include "hil/plant/params.hpp"
#include "hil/scenario/cars_section.hpp"
#include "hil/scenario/match_section.hpp"
#include "hil/scenario/radio_section.hpp"
#include "hil/sensors/detection_params.hpp"
#include "protocol/vocabulary/result.hpp"
#include "protocol/vocabulary/time.hpp"
#include "protocol/vocabulary/units.hpp"
#include "vehicle/world/race_control.hpp"
#include "vehicle/world/receiver.hpp"

namespace pitwall::scenario {

struct Start {
  double s_m = 0.0, n_m = 0.0, speed_mps = 0.0;
  double fuel_l = kUnset;  // in the tank; unset: as the plant file has it
};

inline constexpr double kColdest_c = -20.0, kHottest_c = 150.0;  // tyre temperature

struct Tyres {
  double temperature_c = 85.0;
};

// Differences between the modelled car and world and the parameters that the car uses. Neutral by
// default. Effect of each on the plant: hil/scenario/perturbed.hpp.
struct Perturbations {
  double mass_kg = 0.0;          // added to the car's; [-300, 300]
  double tyre_stiffness = 1.0;   // factor on the slip stiffness at the same friction; [0.5, 2]
  double friction = 1.0;         // factor on every friction coefficient; [0.2, 1.5]
  double bank_error_rad = 0.0;   // true banking less that of the track file; [-5, 5] deg
  double detection_noise = 1.0;  // on the noise of seen cars; [0.2, 5]
  double consumption = 1.0;      // factor on the fuel for the same work; [0.5, 2]
  // The factor is drawn anew by the seed, within so much of it; [0, 0.5].
  double consumption_spread = 0.0;
  double wind_mps = 0.0;     // [0, 40]
  double wind_to_rad = 0.0;  // direction it blows to, in Map, from east counter-clockwise
  // Added to the delays of the actuators; [0, 0.5] s.
  double steering_delay_s = 0.0, throttle_delay_s = 0.0, brake_delay_s = 0.0, gear_delay_s = 0.0;
};

struct FlagChange {
  Duration at{};
  world::TrackFlag track = world::TrackFlag::kNone;
  world::VehicleFlag vehicle = world::VehicleFlag::kNone;
  double round_target_speed_mph = 0.0;

  bool operator==(const FlagChange&) const = default;
};

// Fault by its name in the catalogue; the bench refuses an unknown name or parameter.
struct Fault {
  std::string kind;
  Duration at{}, lasts{};
  std::uint32_t can_id = 0;  // for faults of frames; 0 means every id
  std::uint32_t unit = 0;    // for faults of one of several sensors
  double value = kUnset;     // magnitude, in the unit that the catalogue states
  std::string place;         // for messages
};

// CAN protocol of the drive-by-wire and race control; the bench models V14. kProtected: V14 plus
// messages with checksums, which the car is configured to check.
enum class BusRevision : std::uint8_t { kV14, kV9, kV12, kAv24, kProtected };

// Contact with a wall that the scenario cannot avoid: the highest impact speed, and the reason.
struct NamedContact {
  double at_most_mps = kUnset;
  std::string reason;
};

// How the LiDARs see the other cars. kModel: as detections with drawn errors; kMeasured: with those
// that the car's network was measured to make (lidar_error_file.hpp). Else ray by ray, in lockstep
// only, with the car's own detector behind them: kRays its network, kRaysClusters its clusters.
enum class LidarKind : std::uint8_t { kModel, kMeasured, kRays, kRaysClusters };

constexpr bool has_rays(LidarKind lidars) { return lidars >= LidarKind::kRays; }

// How the cameras see them: as detections with drawn errors; or in rendered images of those in
// front, with the car's own detector behind them.
enum class CameraKind : std::uint8_t { kModel, kRendered };

struct Scenario {
  std::string name;
  std::uint64_t seed = 0;
  Duration duration{};
  std::string track_file, car_file;  // as written: relative to `folder`
  std::string folder{};              // of what it names; by who opens the files
  // Overrides the receivers of the car file; lockstep only.
  std::optional<std::array<world::ReceiverKind, world::kGnssUnits>> receivers;
  BusRevision bus = BusRevision::kV14;
  LidarKind lidars = LidarKind::kModel;
  CameraKind cameras = CameraKind::kModel;
  std::optional<sensors::DetectorErrors> lidar_errors{};  // of kMeasured; by who opens the files
  Start start;
  Tyres tyres;
  std::string plant_file;  // of the modelled car; empty: the AV-21 of hil/plant/params.hpp
  plant::Params plant;     // content of that file; the code that opens the files fills it in
  Perturbations perturb;
  std::vector<OtherCar> cars;
  std::optional<MatchPlan> match;
  std::vector<FlagChange> race_control;
  std::vector<RadioPath> radio;  // empty: no delay, no loss
  std::vector<OperatorText> operator_texts;
  std::vector<Fault> faults;
  std::vector<grading::Expectation> expect;  // named by their place in the file
  std::optional<NamedContact> contact;
};

inline constexpr std::size_t kMaxListed = 256;  // entries of one list of a scenario

Result<Scenario, Problem> read_scenario(const std::string& text, const std::string& name);

const char* name_of(world::TrackFlag flag);
const char* name_of(world::VehicleFlag flag);
const char* name_of(BusRevision revision);
const char* name_of(LidarKind lidars);

}  // namespace pitwall::scenario

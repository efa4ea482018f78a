// Parameters of the modelled car. Every default is a published figure of the AV-21 or marked as an
// estimate; where sources disagree, the one from a driven car is taken.
//   sources [A] autonomalabs/autonoma-awsim vehicle and tyre assets (AV-21 simulator)
//           [T] TUMFTM/mod_vehicle_dynamics_control, driven on the AV-21
//           [D] linklab-uva/deep-dynamics, fitted to AV-21 laps
//           [U] linklab-uva parameters, AV-21 and AV-24
//           [O] TUMFTM/Open-Car-Dynamics defaults
//           [I] Indy Lights tyre set, BenediktRuhland/SA-Tire-model
//           [P] our fit to a recorded AV-21 drive (Putnam Park)
//           [E] estimate
//   units   SI, in the names
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace pitwall::plant {

// Equations of the car. kDoubleTrack: magic formula, quasi-static loads, rigid steering.
// kCompliantBrush: brush tyre, body roll, compliant steering, brakes with a dead band.
enum class Structure : std::uint64_t { kDoubleTrack, kCompliantBrush };
struct NamedStructure {
  std::string_view name;
  Structure structure;
};
inline constexpr std::array kStructures{
    NamedStructure{"double_track", Structure::kDoubleTrack},
    NamedStructure{"compliant_brush", Structure::kCompliantBrush}};

struct Chassis {
  double mass_kg = 790.0;                  // [A] [D]; with fuel
  double yaw_inertia_kgm2 = 800.0;         // [A]; [O] has 1000
  double front_axle_m = 1.724;             // centre of gravity to front axle [O] [U]
  double rear_axle_m = 1.247;              // so that the wheelbase is 2.971 m [U]
  double height_m = 0.28;                  // of the centre of gravity [E]
  double track_front_m = 1.638;            // [U]
  double track_rear_m = 1.523;             // [U]
  double roll_stiffness_front = 0.53;      // share of the lateral load transfer [E]
  double length_m = 4.92, width_m = 1.93;  // over the wheels
  double load_lag_s = 0.05;                // time constant of roll and pitch [E]
};

struct Aero {
  double air_density_kgpm3 = 1.12;                             // 600 m above the sea at 25 C
  double drag_area_m2 = 0.858;                                 // [A] Cd A
  double front_lift_area_m2 = 0.65, rear_lift_area_m2 = 1.18;  // [A] downforce positive
  // Side force per dynamic pressure and angle of the wind, and its distance ahead of the centre of
  // gravity. A passenger car has 4 to 5 m2; ours is scaled by the ratio of the silhouettes [E].
  double side_area_m2 = 2.0;
  double side_arm_m = 0.0;  // [E]
};

// Normalised-slip magic formula: force = mu Fz sin(C atan(B rho)), with rho = slip / slip of the
// peak, and B such that the peak is at rho = 1; the direction is that of the slip (similarity).
struct Tyre {
  double radius_m = 0.3;
  double nominal_load_n = 2000.0;
  double mu_long = 1.5, mu_lat = 1.5;
  double shape = 1.6;             // C
  double peak_slip_ratio = 0.09;  // [E]
  double peak_slip_angle_rad = 0.08;
  double load_sensitivity = 0.168;    // loss of mu per relative load above nominal [I] PDX2/PDX1
  double mu_min_share = 0.4;          // floor of that loss
  double relaxation_m = 0.1;          // [A]
  double wheel_inertia_kgm2 = 1.0;    // [E]
  double rolling_resistance = 0.012;  // [E] of the load, at TyreThermal::working_c
};

// Steering: a motor that is geared to the road wheels, left positive.
struct Steering {
  double ratio = 19.5;                         // motor : road wheel [T]; [U] AV-24 15
  double delay_s = 0.040;                      // [A] [T]
  double lag_s = 0.060;                        // PT1 [A] [O]
  double rate_max_rad_per_s = 7.854;           // 450 deg/s at the motor; [A] 360 to 500
  double angle_max_rad = 4.189;                // 240 deg at the motor [A]
  double quantum_rad = 0.0087266462599716477;  // 0.5 deg, the resolution of the command
};

struct Brakes {
  double lag_s = 0.100;              // [O] dummy AV-24 configuration
  double delay_s = 0.0;              // command to first movement; [A] 0.040, not from a car
  double pressure_max_kpa = 9000.0;  // [A]
  // Per whole axle. Both axles 0.65 [P]; 54 % in front [A] (brakeBias; the bias knob of the AV-24's
  // dash goes from 50 to 58 %). Both circuits have the same pressure, so the front wheels lock
  // first.
  double front_nm_per_kpa = 0.351;
  double rear_nm_per_kpa = 0.299;
  // Share of each axle's torque that remains: a fault lowers it.
  double front_remaining = 1.0, rear_remaining = 1.0;
};

struct EnginePoint {
  double rpm, torque_nm;
};
inline constexpr std::size_t kEnginePoints = 18;

// Throttles of the dyno sheet; the share at the last one is 1.
inline constexpr std::array<double, 6> kDynoThrottles{0.30, 0.50, 0.65, 0.70, 0.80, 1.00};
struct PartThrottle {
  double rpm;
  std::array<double, kDynoThrottles.size()> share;  // of the full torque
};
inline constexpr std::size_t kPartThrottleRows = 11;

struct Engine {
  // Full throttle. 3500 to 6780 rpm: dyno [U]; 2500 and 3000: [A] polynomial; the rest [E].
  std::array<EnginePoint, kEnginePoints> full_throttle{{{0.0, 0.0},
                                                        {1000.0, 0.0},
                                                        {2000.0, 90.0},
                                                        {2500.0, 184.0},
                                                        {3000.0, 303.0},
                                                        {3500.0, 400.0},
                                                        {3565.0, 425.6},
                                                        {3717.0, 459.1},
                                                        {4000.0, 462.0},
                                                        {4308.0, 478.6},
                                                        {4500.0, 478.0},
                                                        {4930.0, 479.7},
                                                        {5080.0, 473.8},
                                                        {5500.0, 467.0},
                                                        {5900.0, 458.3},
                                                        {6500.0, 422.0},
                                                        {6780.0, 395.1},
                                                        {7200.0, 365.0}}};
  // Part throttle, dyno [U]: all of 3565 to 6780 rpm except 30 % above 5080 rpm, and 30 % from
  // 2550 rpm on; the rest [E].
  std::array<PartThrottle, kPartThrottleRows> part_throttle{
      {{2550.0, {0.5710, 0.80, 0.92, 0.96, 0.99, 1.0}},
       {2800.0, {0.4315, 0.70, 0.90, 0.95, 0.987, 1.0}},
       {3000.0, {0.3466, 0.62, 0.88, 0.94, 0.985, 1.0}},
       {3565.0, {0.2087, 0.4752, 0.8321, 0.9217, 0.9850, 1.0}},
       {3717.0, {0.1830, 0.4926, 0.8024, 0.9198, 0.9943, 1.0}},
       {4308.0, {0.1304, 0.6422, 0.7809, 0.9092, 0.9874, 1.0}},
       {4450.0, {0.1294, 0.6605, 0.7795, 0.9011, 0.9869, 1.0}},
       {4930.0, {0.1025, 0.5749, 0.8007, 0.8909, 0.9858, 1.0}},
       {5080.0, {0.0950, 0.5447, 0.8232, 0.9076, 0.9921, 1.0}},
       {6000.0, {0.0500, 0.4975, 0.8451, 0.9252, 0.9811, 1.0}},
       {6780.0, {0.0200, 0.2943, 0.8630, 0.9150, 0.9937, 1.0}}}};
  double limiter_rpm = 7200.0;  // [A]; torque falls to zero over the next 100 rpm
  double limiter_width_rpm = 100.0;
  double friction_nm = 30.0;           // [A]
  double friction_nm_per_rpm = 0.004;  // [E]
  double inertia_kgm2 = 0.08;          // [E]
  double idle_rpm = 1500.0;            // [E]
  double launch_rpm = 2800.0;          // minimum engine speed, held by the slipping clutch [E]
  double throttle_lag_s = 0.050;       // [O] dummy AV-24 configuration
  double throttle_delay_s = 0.0;       // command to first movement, as for the brakes
  double crank_s = 1.0;                // starter to running [E]
  double power = 1.0;  // remaining share of the combustion torque: a fault lowers it
};

// Chassis::mass_kg includes the fuel of a full tank; the car gets lighter as it burns. The position
// of the fuel in the car is not modelled. An empty tank stops the engine.
struct Fuel {
  double start_kg = 50.0;        // in the tank at the start [E]
  double heating_jpkg = 42.7e6;  // petrol
  // Share of the fuel's energy that becomes work, before friction: 0.31 kg/kWh at full power, like
  // a turbo engine that runs rich [E].
  double efficiency = 0.30;
};

inline constexpr std::size_t kGears = 6;

struct Drivetrain {
  std::array<double, kGears> gear{2.9167, 1.875, 1.3809, 1.1154, 0.96, 0.8889};  // [U] 35/12..24/27
  double final_drive = 3.0;                                                      // [U] [A]
  double efficiency = 0.93;                                                      // [E]
  double shift_s = 0.080;                  // torque is cut [E]
  double lockout_s = 0.300;                // no further shift is accepted for this time [E]
  double shift_delay_s = 0.0;              // from the gear command to the begin of the shift
  double differential_nms_per_rad = 40.0;  // limited slip: torque per difference of speed [E]
  double differential_max_nm = 400.0;      // [E]
};

// Tread and belt of one tyre.
struct TyreBody {
  double heat_capacity_jpk, surface_m2;
};

// tyre_thermal.hpp has the equations and the sources of the numbers. Unvalidated.
struct TyreThermal {
  double ambient_c = 25.0;
  double working_c = 79.0, hot_c = 110.0;               // full grip between them; 175 F, [E]
  double ruined_c = 150.0;                              // full loss of grip by heat [E]
  TyreBody front{7'000.0, 0.84}, rear{10'000.0, 1.13};  // from their size [E]
  double still_air_w_per_m2k = 11.0;                    // at rest, with radiation
  double moving_air_w_per_m2k = 6.15;                   // at 1 m/s; grows with speed^0.8
  double rubber_m2k_per_w = 0.017;     // from the middle of the rubber to its surface
  double slip_heat_share = 0.4;        // share of the friction power that the tyre keeps
  double rolling_heat_share = 0.9;     // share of the power of rolling resistance
  double rolling_fall_per_k = 0.0125;  // decrease of rolling resistance as the tyre warms
  double cold_grip_loss = 0.4;         // share of grip lost at ambient [E]
  double hot_grip_loss = 0.0;          // share of grip lost at ruined_c
};

// Only Structure::kCompliantBrush uses the following four.

// Parameters of the brush tyre in addition to Tyre, the same for both axles; Tyre::shape is not
// used.
struct Brush {
  double stiffest_load = 3.0;     // load of the largest stiffness, over the nominal load [E]
  double sliding_friction = 0.8;  // friction far beyond the peak, over that at the peak [E]
  double sliding_slips = 3.0;     // peak slips beyond the peak for half of that loss [E]
  double trail_m = 0.03;          // pneumatic trail at nominal load without slip [E]
};

struct Suspension {
  double roll_inertia_kgm2 = 265.0;  // [A]
  // Springs, anti-roll bars and tyre walls in series: 0.5 degree per g [E].
  double front_nm_per_rad = 122e3, rear_nm_per_rad = 98e3;
  double front_nms_per_rad = 2100.0, rear_nms_per_rad = 1700.0;  // a quarter of critical [E]
  double front_centre_m = 0.02, rear_centre_m = 0.04;            // height of the roll centres [E]
};

// Compliance between steering motor and road wheels.
struct SteeringCompliance {
  double rad_per_nm = 9e-5;     // at the road wheels, per total moment of both [E]
  double caster_trail_m = 0.0;  // in addition to the pneumatic trail [E]
  double lag_s = 0.02;          // [E]
};

struct BrakeHydraulics {
  double dead_band_kpa = 150.0;  // pressure until the pads touch [E]
  double release_lag_s = 0.16;   // lag of falling pressure, longer than Brakes::lag_s [E]
};

struct Params {
  Structure structure = Structure::kDoubleTrack;
  Chassis chassis;
  Aero aero;
  Tyre front{.radius_m = 0.301,         // [T]
             .nominal_load_n = 1700.0,  // [A], as all of the following
             .mu_long = 1.2,
             .mu_lat = 1.5,
             .shape = 1.5,
             .peak_slip_angle_rad = 0.08725};
  Tyre rear{.radius_m = 0.3118,
            .nominal_load_n = 2200.0,
            .mu_long = 1.7,
            .mu_lat = 1.55,
            .shape = 1.6,
            .peak_slip_angle_rad = 0.0785};
  Steering steering;
  Brakes brakes;
  Engine engine;
  Fuel fuel;
  Drivetrain drivetrain;
  TyreThermal thermal;
  Brush brush;
  Suspension suspension;
  SteeringCompliance compliance;
  BrakeHydraulics hydraulics;
  // Below this speed the tyre acts as a damped spring, so that the car comes to rest.
  double low_speed_mps = 3.0;
  double low_speed_damping_nspm = 4'000.0;  // per tyre, at standstill [E]
  double substep_s = 0.001;
};

}  // namespace pitwall::plant

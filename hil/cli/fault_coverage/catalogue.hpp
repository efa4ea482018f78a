// Catalogue of the faults that the car has to detect, each at least once. Of F01 to F40 it omits
// faults that need a LiDAR or camera (F26 to F28) or concern more than one part (F37 to F40:
// memory, disk, pairs).
//   source fault catalogue of the bench
//
// Deadlines of the actuator faults, from the effect that a fault may have on the road. `pitwall-hil
// faults` gives the measured figures. Those under yellow and of the planner were known when this
// was written; the deadlines at walking and racing speed were set before their first run.
//   steering  permitted deviation from the line 0.5 m, one fifth of the smallest gap to a wall
//             (2.5 m). At the steepest turn entry the curvature changes by k = 1.9e-5 / m^2 (LVMS,
//             s 360 to 475). A motor that holds its angle there leaves the line by k D^3 / 6 after
//             D metres: 0.5 m after 54 m. That is 13 s at 4 m/s, 2.4 s at 22 m/s, 0.9 s at 60 m/s.
//             Measured 10.6 s, 1.1 s, 0.6 s
//             A motor of the rate w follows a share r = w / (ratio k (l + K v^2) v) of the rate
//             that the entry needs, and D = 54 m / (1 - r)^(1/3). For 0.02 rad/s and ratio 19.5, l
//             2.97 m, K 0.0002: r 0.80 at 22 m/s, 92 m, 4.2 s; r 0.24 at 60 m/s, 59 m, 1.0 s; at
//             walking speed the entry needs 0.004 rad/s, so there is no error. Measured 3.8 s,
//             0.8 s
//             Shorter deadlines are impossible: the fault is not observable before the motor angle
//             is wrong by 0.05 rad (noise and play), which takes 2 s in the entry at 22 m/s
//   throttle  permitted increase of the stopping distance: one tenth. Stuck for t, the throttle
//             adds p t to the speed and p t v / a to the stopping distance v^2 / 2 a, so t =
//             0.05 v / p: with the p of a throttle that holds the speed, 0.3 m/s^2 at 4 m/s and
//             0.5 m/s^2 at 22 m/s, 0.67 s and 2.2 s; fully open, 3 m/s^2 at 44 m/s, 0.73 s. The
//             deadline is half a second at every speed. Measured 0.32 s, 0.36 s, 0.38 s
//   planner   20 Hz; meanwhile the car follows the last plan with its stop path, which reaches
//             further than a stop needs. Late after 2.5 periods and two ticks (145 ms, 6 m at
//             44 m/s): the car coasts; lost after 0.5 s and two ticks (22 m): the car stops.
//             Measured 80 ms. A planner without a position does not count as failed: the loss of
//             the position stops the car
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string_view>

namespace pitwall::fault_coverage {

struct CatalogueRow {
  std::string_view id, fault;
};

inline constexpr std::array<CatalogueRow, 33> kCatalogue{{
    {"F01", "frames of one message lost now and then"},
    {"F02", "bursts of lost frames"},
    {"F03", "one message gone"},
    {"F04", "all messages gone"},
    {"F05", "frames late"},
    {"F06", "frames twice"},
    {"F07", "flipped bits"},
    {"F08", "counter stands still"},
    {"F09", "counter jumps"},
    {"F10", "wrong checksum, right counter"},
    {"F11", "wrong length, unknown or extended identifier"},
    {"F12", "another node speaks with our identifiers"},
    {"F13", "a node babbles"},
    {"F14", "controller warned, passive, bus-off"},
    {"F15", "nothing can be sent"},
    {"F16", "frozen value, live counter"},
    {"F17", "offset, drift, noise, saturation"},
    {"F18", "no number, no such state"},
    {"F19", "receiver silent or without a solution"},
    {"F20", "receiver's deviation too large"},
    {"F21", "position jumps"},
    {"F22", "stamps frozen, back, ahead"},
    {"F23", "heading turned round"},
    {"F24", "IMU biased or gone"},
    {"F25", "one wheel speed wrong"},
    {"F29", "radio gone"},
    {"F30", "flags unknown or contradictory"},
    {"F31", "race control's heartbeat stops"},
    {"F32", "steering stuck, slow, biased"},
    {"F33", "brake loses pressure"},
    {"F34", "throttle stuck"},
    {"F35", "clock steps or runs wrong"},
    {"F36", "process stopped or killed"},
}};

}  // namespace pitwall::fault_coverage

// The faults that the car has to notice, each at least once. What is left out of F01 to F40 needs
// a LiDAR or camera (F26 to F28), is no fault of one part (F37 to F40: memory, disk, pairs), or
// both.
//   source fault catalogue of the bench
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string_view>

namespace pitwall::matrix {

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

}  // namespace pitwall::matrix

// SPDX-License-Identifier: Apache-2.0
#include "hil/nodes/flag_encoding.hpp"

#include <array>

namespace pitwall::race {
namespace {

using world::TrackFlag;
using world::VehicleFlag;

constexpr std::uint8_t kUnlistedMyLaps = 15, kUnlistedMarelli = 255;
constexpr std::array kMarelliSpeeds_mph{40,  60,  80,  100, 120, 125, 130, 135, 140, 145,
                                        150, 155, 160, 165, 170, 175, 180, 185, 190};

std::uint8_t mylaps_track(TrackFlag flag) {
  switch (flag) {
    case TrackFlag::kNone:
      return 0;
    case TrackFlag::kRed:
      return 1;
    case TrackFlag::kOrange:
      return 2;
    case TrackFlag::kYellow:
    case TrackFlag::kChequered:  // the flag itself goes to the vehicle field
      return 3;
    case TrackFlag::kGreen:
      return 4;
    case TrackFlag::kWavingGreen:
      return 8;
    case TrackFlag::kUnknown:
      break;
  }
  return kUnlistedMyLaps;
}

std::uint8_t mylaps_vehicle(VehicleFlag flag) {
  switch (flag) {
    case VehicleFlag::kNone:
    case VehicleFlag::kBlue:
    case VehicleFlag::kStop:               // as track red
    case VehicleFlag::kOrangeStartEngine:  // as track orange
    case VehicleFlag::kYellow:             // as track yellow
      return 0;
    case VehicleFlag::kBlackPitIn:
      return 2;
    case VehicleFlag::kChequered:
      return 4;
    case VehicleFlag::kDefender:
      return 5;
    case VehicleFlag::kAttacker:
      return 7;
    case VehicleFlag::kPurpleEmergency:
    case VehicleFlag::kEngineKill:
      return 8;
    case VehicleFlag::kUnknown:
      break;
  }
  return kUnlistedMyLaps;
}

std::uint8_t marelli_track(TrackFlag flag) {
  switch (flag) {
    case TrackFlag::kNone:
    case TrackFlag::kOrange:  // goes to the vehicle field
      return 0;
    case TrackFlag::kGreen:
      return 1;
    case TrackFlag::kRed:
      return 3;
    case TrackFlag::kChequered:
      return 4;
    case TrackFlag::kYellow:
      return 9;
    case TrackFlag::kWavingGreen:
      return 37;
    case TrackFlag::kUnknown:
      break;
  }
  return kUnlistedMarelli;
}

std::uint8_t marelli_vehicle(VehicleFlag flag) {
  switch (flag) {
    case VehicleFlag::kNone:
    case VehicleFlag::kChequered:  // as track chequered
      return 0;
    case VehicleFlag::kBlue:
      return 2;
    case VehicleFlag::kBlackPitIn:
      return 4;
    case VehicleFlag::kYellow:
      return 7;
    case VehicleFlag::kOrangeStartEngine:
      return 25;
    case VehicleFlag::kPurpleEmergency:
      return 32;
    case VehicleFlag::kEngineKill:
      return 33;
    case VehicleFlag::kStop:
      return 34;
    case VehicleFlag::kDefender:
      return 35;
    case VehicleFlag::kAttacker:
      return 36;
    case VehicleFlag::kUnknown:
      break;
  }
  return kUnlistedMarelli;
}

bool rolls(TrackFlag flag) {
  return flag == TrackFlag::kNone || flag == TrackFlag::kGreen || flag == TrackFlag::kWavingGreen;
}

// Says nothing that slows the car, so that another flag may take its field.
bool yields(VehicleFlag flag) {
  return flag == VehicleFlag::kNone || flag == VehicleFlag::kBlue ||
         flag == VehicleFlag::kAttacker || flag == VehicleFlag::kDefender;
}

}  // namespace

RawFlags to_mylaps(const Flags& flags) {
  Flags sent = flags;
  if (flags.track != TrackFlag::kUnknown) {
    if (flags.vehicle == VehicleFlag::kYellow && rolls(flags.track))
      sent.track = TrackFlag::kYellow;
    if (flags.vehicle == VehicleFlag::kOrangeStartEngine && flags.track != TrackFlag::kRed)
      sent.track = TrackFlag::kOrange;
    if (flags.vehicle == VehicleFlag::kStop) sent.track = TrackFlag::kRed;
  }
  if (flags.track == TrackFlag::kChequered && yields(flags.vehicle))
    sent.vehicle = VehicleFlag::kChequered;
  return {mylaps_track(sent.track), mylaps_vehicle(sent.vehicle)};
}

RawFlags to_marelli(const Flags& flags, double round_target_speed_mph) {
  Flags sent = flags;
  if (flags.track == TrackFlag::kOrange && yields(flags.vehicle))
    sent.vehicle = VehicleFlag::kOrangeStartEngine;
  const bool covers = rolls(flags.track) || flags.track == TrackFlag::kOrange;
  if (flags.vehicle == VehicleFlag::kChequered && covers) sent.track = TrackFlag::kChequered;
  RawFlags raw{marelli_track(sent.track), marelli_vehicle(sent.vehicle)};
  if (sent.track == TrackFlag::kGreen)
    for (const int known_mph : kMarelliSpeeds_mph)
      if (round_target_speed_mph == known_mph) raw.track = static_cast<std::uint8_t>(known_mph);
  return raw;
}

}  // namespace pitwall::race

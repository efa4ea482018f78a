// Labels of the values of enumerated fields, in the order of the enumerations of vehicle/world and
// vehicle/safety, which this folder must not include; vehicle/pipeline/telemetry_mapper compares
// them.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string_view>

namespace pitwall::telemetry {

inline constexpr std::string_view kModes =
    "disarmed|standby|driving|controlled stop|emergency stop|halted|coast";
inline constexpr std::string_view kCtStates =
    "-|power on|initialized|actuator test|crank ready|cranking|race ready|init driving|caution|"
    "nominal race|coordinated stop|controlled shutdown|emergency shutdown";
inline constexpr std::string_view kSysStates =
    "unknown|power on|subsystems connected|actuator testing|actuator test done|crank ready|"
    "pre-crank check|cranking|engine running|driving|shut engine|power off|raptor off|"
    "crank check init|actuator test failed|crank checks failed|emergency shutdown|"
    "engine failed to start|critical limits exceeded|standby";
inline constexpr std::string_view kTrackFlags =
    "none|RED|ORANGE|YELLOW|GREEN|WAVING GREEN|CHEQUERED|UNKNOWN";
// Flags that race control can show: all but the last, which stands for an unknown flag.
inline constexpr std::string_view kShownTrackFlags = kTrackFlags.substr(0, kTrackFlags.rfind('|'));
inline constexpr std::string_view kVehicleFlags =
    "none|BLACK PIT IN|BLUE|STOP|PURPLE EMERGENCY|ENGINE KILL|ORANGE START ENGINE|YELLOW|CHEQUERED|"
    "DEFENDER|ATTACKER|UNKNOWN";
inline constexpr std::string_view kValidities = "never|good|dead reckoning|lost";
inline constexpr std::string_view kIdentities = "listening|right|wrong";
inline constexpr std::string_view kControllerStates = "unknown|active|warning|passive|BUS OFF|down";
inline constexpr std::string_view kBaseStates = "not watched|never heard|heard|late|LOST";
inline constexpr std::string_view kArmings =
    "not asked|armed|waits for a fault to pass|REFUSED: the car moves|"
    "REFUSED: the last run ended while armed|SPENT: release and arm anew";
inline constexpr std::string_view kNoYes = "no|yes";
inline constexpr std::string_view kLinkLossLevels =
    "full|joystick dropped|override gone|no-comm|controlled stop";
inline constexpr std::string_view kShiftStates =
    "not initialised|ready|locked out|shifts up|shifts down";
inline constexpr std::string_view kUnitSets = "none|unit 0|unit 1|both";
// Bits of a set of sensors, by the names that an operator enters.
inline constexpr std::string_view kExcludableNames =
    "gnss0|gnss1|imu0|imu1|wheels|lidar|camera0|camera1|radar";
inline constexpr std::string_view kSampleVerdicts =
    "-|in use|NOT A NUMBER|no such unit|no solution|too uncertain|too old|from the future|JUMPED|"
    "waits for a start|stands by|IMPLAUSIBLE|excluded|NEGATIVE VARIANCE|old corrections|"
    "WRONG BASELINE|STAMP STANDS STILL|STAMP RAN BACK|FROZEN|CONTRADICTS THE OTHER|OFF ITS COURSE|"
    "receiver error|on probation|SILENT";
inline constexpr std::string_view kRoles = "none|defender|attacker";
inline constexpr std::string_view kPrimitives =
    "-|holds the line|stops|merges|trails|passes|closes the door|gives way";
inline constexpr std::string_view kSpeedReasons =
    "-|no position|no race control|no flag|unknown flag|red|orange|black|stop|chequered|caution|"
    "green|round speed|operator|line|tyres|governor|trail|pass|gives way|car ahead|declined: "
    "fuel|fuel for the way home|pit lane|box";
inline constexpr std::string_view kStopLevels = "none|controlled stop|EMERGENCY STOP";
inline constexpr std::string_view kStopReasons =
    "none|operator|race control|pit crew|console lost its operator|test";
inline constexpr std::string_view kStopCauses =
    "none|operator: emergency stop|purple flag|CAN bus dead: the drive-by-wire is silent|"
    "drive-by-wire: system failure|"
    "drive-by-wire: emergency brake|drive-by-wire: steering lost|"
    "drive-by-wire: emergency shutdown|operator: stop|operator: disarm|engine-kill flag|"
    "drive-by-wire: engine lost|drive-by-wire: brake out of spec|"
    "drive-by-wire: critical limits|drive-by-wire: does not hear us|"
    "CAN bus does not fit the database|CAN bus off|"
    "another node sends our CAN ids|CAN message lost|frame gate refused commands|"
    "control failed|planning failed or late|localization lost|dead reckoning too long|"
    "position too uncertain|GNSS unit disconnected|GNSS: both units miss the rate|"
    "GNSS: both units lost the solution|IMU: both units lost|race control lost|"
    "race control lost, says the drive-by-wire|base station lost|"
    "GNSS: both units lost RTK and their accuracy|steering motor does not do as it is told|"
    "steering rod: the car turns otherwise than its motor|"
    "brake does not do as it is told|throttle does not do as it is told|"
    "computer misses too many ticks|computer out of memory|computer too hot|"
    "over-steer: rear wheels spin|over-steer: rear wheels lock|"
    "over-steer: the car yaws more than steered|no good position|planning a beat late|"
    "control a beat late|front wheels lock: less brake|"
    "race control: flags unknown or contradictory|"
    "race control: round speed above the car's, capped|computer missed ticks|computer busy|"
    "a clock stepped|clock too fast or slow|GNSS: one unit is bad";
// Unit of the value that belongs to each cause; "-": the value has no meaning for an operator.
inline constexpr std::string_view kStopCauseUnits =
    "-|-|-|s|-|-|-|-|-|-|-|-|-|-|-|-|-|-|-|ticks|ticks|s|-|s|m|s|s|s|s|s|-|s|m|rad|rad|kPa|of 1|"
    "s|MiB|degC|-|-|-|s|s|ticks|-|-|m/s|s|of 1|s|ppm|-";
// Bits of a set of attacks and key errors, in the order of telemetry::Threat.
inline constexpr std::string_view kThreatNames =
    "wrong key|sealed against signed|refused at rate|second peer|replayed openings|relay";

// The rest of "a|b|c" without its first `first` names.
constexpr std::string_view labels_from(std::string_view labels, std::size_t first) {
  for (; first > 0; --first) {
    const std::size_t bar = labels.find('|');
    if (bar == std::string_view::npos) return {};
    labels.remove_prefix(bar + 1);
  }
  return labels;
}

// Two bit sets hold the causes: bit k of the first is cause k + 1, bit k of the second is k + 32.
inline constexpr std::size_t kFaultBits = 31;
inline constexpr std::string_view kFaultNamesMore = labels_from(kStopCauses, 1 + kFaultBits);
inline constexpr std::string_view kFaultNames =
    labels_from(kStopCauses, 1)
        .substr(0, labels_from(kStopCauses, 1).size() - kFaultNamesMore.size() - 1);

// Number of names in "a|b|c".
constexpr std::size_t label_count(std::string_view labels) {
  std::size_t count = labels.empty() ? 0 : 1;
  for (const char c : labels) count += c == '|' ? 1U : 0U;
  return count;
}

// The name at this index of "a|b|c"; empty past the end.
constexpr std::string_view label_at(std::string_view labels, std::size_t index) {
  const std::string_view rest = labels_from(labels, index);
  return rest.substr(0, rest.find('|'));
}

static_assert(label_count(kStopCauseUnits) == label_count(kStopCauses));

}  // namespace pitwall::telemetry

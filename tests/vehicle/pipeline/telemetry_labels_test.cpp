// SPDX-License-Identifier: Apache-2.0
// The labels of the telemetry registry name enumerations that it must not include: here both are
// seen.
#include "protocol/telemetry/registry/labels.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <string>
#include <vector>

#include "hil/scenario/scenario.hpp"
#include "vehicle/pipeline/step.hpp"

namespace pitwall::pipeline {
namespace {

std::vector<std::string> names_in(std::string_view labels) {
  std::vector<std::string> names;
  for (std::size_t i = 0; !telemetry::label_at(labels, i).empty(); ++i)
    names.emplace_back(telemetry::label_at(labels, i));
  return names;
}

template <class E>
std::vector<std::string> in_order(std::vector<std::pair<E, std::string>> rows) {
  std::vector<std::string> names;
  for (const auto& [value, name] : rows) {
    EXPECT_EQ(static_cast<std::size_t>(value), names.size()) << name;
    names.push_back(name);
  }
  return names;
}

TEST(TelemetryLabels, NameTheModes) {
  using enum world::Mode;
  const auto names = in_order<world::Mode>({{kDisarmed, "disarmed"},
                                            {kStandby, "standby"},
                                            {kDriving, "driving"},
                                            {kControlledStop, "controlled stop"},
                                            {kEmergencyStop, "emergency stop"},
                                            {kHalted, "halted"},
                                            {kCoast, "coast"}});
  EXPECT_EQ(names, names_in(telemetry::kModes));
  EXPECT_EQ(names.size(), world::kModes);
}

TEST(TelemetryLabels, NameTheStatesOfTheComputer) {
  using enum world::CtState;
  EXPECT_EQ(in_order<world::CtState>({{static_cast<world::CtState>(0), "-"},
                                      {kPowerOn, "power on"},
                                      {kInitialized, "initialized"},
                                      {kActuatorTest, "actuator test"},
                                      {kCrankReady, "crank ready"},
                                      {kCranking, "cranking"},
                                      {kRaceReady, "race ready"},
                                      {kInitDriving, "init driving"},
                                      {kCaution, "caution"},
                                      {kNominalRace, "nominal race"},
                                      {kCoordinatedStop, "coordinated stop"},
                                      {kControlledShutdown, "controlled shutdown"},
                                      {kEmergencyShutdown, "emergency shutdown"}}),
            names_in(telemetry::kCtStates));
}

TEST(TelemetryLabels, NameTheStatesOfTheDriveByWire) {
  using enum world::SysState;
  EXPECT_EQ(in_order<world::SysState>({{kUnknown, "unknown"},
                                       {kPowerOn, "power on"},
                                       {kSubsystemsConnected, "subsystems connected"},
                                       {kActuatorTesting, "actuator testing"},
                                       {kActuatorTestDone, "actuator test done"},
                                       {kCrankReady, "crank ready"},
                                       {kPreCrankCheck, "pre-crank check"},
                                       {kCranking, "cranking"},
                                       {kEngineRunning, "engine running"},
                                       {kDriving, "driving"},
                                       {kShutEngine, "shut engine"},
                                       {kPowerOff, "power off"},
                                       {kRaptorOff, "raptor off"},
                                       {kCrankCheckInit, "crank check init"},
                                       {kActuatorTestFailed, "actuator test failed"},
                                       {kCrankChecksFailed, "crank checks failed"},
                                       {kEmergencyShutdown, "emergency shutdown"},
                                       {kEngineFailedToStart, "engine failed to start"},
                                       {kCriticalLimitsExceeded, "critical limits exceeded"},
                                       {kStandby, "standby"}}),
            names_in(telemetry::kSysStates));
}

TEST(TelemetryLabels, NameTheValidities) {
  using enum world::Validity;
  EXPECT_EQ(in_order<world::Validity>({{kNever, "never"},
                                       {kGood, "good"},
                                       {kDeadReckoning, "dead reckoning"},
                                       {kLost, "lost"}}),
            names_in(telemetry::kValidities));
}

TEST(TelemetryLabels, NameWhatBecameOfTheArmRequest) {
  using enum safety::Arming;
  EXPECT_EQ(in_order<safety::Arming>({{kNotRequested, "not asked"},
                                      {kArmed, "armed"},
                                      {kBarred, "waits for a fault to pass"},
                                      {kCarMoves, "REFUSED: the car moves"},
                                      {kLastRunArmed, "REFUSED: the last run ended while armed"},
                                      {kUsed, "SPENT: release and arm anew"}}),
            names_in(telemetry::kArmings));
  const auto names = names_in(telemetry::kArmings);
  for (std::size_t i = 0; i < names.size(); ++i)
    EXPECT_EQ(names[i], safety::text_of(static_cast<safety::Arming>(i)));
}

TEST(TelemetryLabels, NameWhyTheSpeedIsWhatItIs) {
  using enum planning::Reason;
  EXPECT_EQ(in_order<planning::Reason>({{kUnknown, "-"},
                                        {kNoEgo, "no position"},
                                        {kNoRaceControl, "no race control"},
                                        {kNoFlag, "no flag"},
                                        {kUnknownFlag, "unknown flag"},
                                        {kRed, "red"},
                                        {kOrange, "orange"},
                                        {kBlack, "black"},
                                        {kStopFlag, "stop"},
                                        {kChequered, "chequered"},
                                        {kCaution, "caution"},
                                        {kGreen, "green"},
                                        {kRoundSpeed, "round speed"},
                                        {kOperatorLimit, "operator"},
                                        {kLineLimit, "line"},
                                        {kTyreLimit, "tyres"},
                                        {kCornerAhead, "governor"},
                                        {kTrail, "trail"},
                                        {kPass, "pass"},
                                        {kGiveWay, "gives way"},
                                        {kCarAhead, "car ahead"},
                                        {kDeclined, "declined: fuel"},
                                        {kFuelHome, "fuel for the way home"},
                                        {kPitLane, "pit lane"},
                                        {kBox, "box"}}),
            names_in(telemetry::kSpeedReasons));
}

TEST(TelemetryLabels, NameTheLinkLossLevels) {
  using enum safety::LinkLossLevel;
  EXPECT_EQ(in_order<safety::LinkLossLevel>({{kFull, "full"},
                                             {kJoystickDropped, "joystick dropped"},
                                             {kOverrideGone, "override gone"},
                                             {kNoComm, "no-comm"},
                                             {kStop, "controlled stop"}}),
            names_in(telemetry::kLinkLossLevels));
}

TEST(TelemetryLabels, NameHowTheBaseIsHeard) {
  using enum safety::Health;
  EXPECT_EQ(in_order<safety::Health>({{kUnwatched, "not watched"},
                                      {kNever, "never heard"},
                                      {kGood, "heard"},
                                      {kWarning, "late"},
                                      {kBad, "LOST"}}),
            names_in(telemetry::kBaseStates));
}

TEST(TelemetryLabels, NameTheCausesOfAStop) {
  const auto names = names_in(telemetry::kStopCauses);
  ASSERT_EQ(names.size(), safety::kCauses);
  for (std::size_t i = 0; i < names.size(); ++i)
    EXPECT_EQ(names[i], safety::text_of(static_cast<safety::Cause>(i)));
}

// The bench names flags in lower case with underscores, and shorter.
template <class Flag>
void agrees_with_the_bench(std::string_view labels, Flag last) {
  const auto names = names_in(labels);
  ASSERT_EQ(names.size(), static_cast<std::size_t>(last) + 1);
  for (std::size_t i = 0; i < names.size(); ++i) {
    std::string lower = names[i];
    std::transform(lower.begin(), lower.end(), lower.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    std::replace(lower.begin(), lower.end(), ' ', '_');
    EXPECT_TRUE(lower.starts_with(scenario::name_of(static_cast<Flag>(i))))
        << lower << " and " << scenario::name_of(static_cast<Flag>(i));
  }
}

TEST(TelemetryLabels, NameTheFlagsAsTheBenchDoes) {
  agrees_with_the_bench(telemetry::kTrackFlags, world::TrackFlag::kUnknown);
  agrees_with_the_bench(telemetry::kVehicleFlags, world::VehicleFlag::kUnknown);
}

}  // namespace
}  // namespace pitwall::pipeline

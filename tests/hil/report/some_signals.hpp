// Small CAN database and a log with known signals: a hundred frames of 10 ms.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>
#include <string>

#include "hil/replay/formats/can_log.hpp"
#include "hil/report/signal_series.hpp"
#include "protocol/can/dbc_parser.hpp"

namespace pitwall::report {

inline constexpr std::size_t kSomeFrames = 100;
inline constexpr std::int64_t kSomeBegin_ns = 1'700'000'000'000'000'000;

inline can::Database some_database() {
  auto database = can::parse_dbc_leniently(R"(VERSION ""
BU_: Car
BO_ 16 Drive: 8 Car
 SG_ Speed : 0|16@1- (0.05,-10) [0|0] "km/h" Car
 SG_ Wheel : 16|16@1- (0.05,-10) [0|0] "km/h" Car
 SG_ Gear : 32|8@1+ (1,0) [0|0] "" Car
 SG_ Page M : 40|8@1+ (1,0) [0|0] "" Car
 SG_ Odd m1 : 48|8@1+ (1,0) [0|0] "" Car
 SG_ Never m9 : 48|8@1+ (1,0) [0|0] "" Car
BO_ 17 Silent: 8 Car
 SG_ Value : 0|8@1+ (1,0) [0|0] "" Car
BO_ 32 Wild: 8 Car
 SG_ Real : 0|64@1- (1,0) [0|0] "" Car
SIG_VALTYPE_ 32 Real : 2;
VAL_ 16 Gear 0 "park & <wait>" 1 "drive" 2 "a name that is far too long" ;
)",
                                           "some.dbc");
  CHECK(database);
  return *std::move(database);
}

inline ChosenSignal some_signal(const can::Database& database, const std::string& message,
                                const std::string& signal) {
  const can::Message* const found = database.find(message);
  CHECK(found != nullptr && found->find(signal) != nullptr);
  return {found, found->find(signal)};
}

inline std::int16_t raw_speed_at(std::size_t i) {
  return static_cast<std::int16_t>(std::lround(4000.0 * std::sin(0.1 * static_cast<double>(i))));
}
inline double speed_at(std::size_t i) { return 0.05 * raw_speed_at(i) - 10.0; }
inline std::uint8_t gear_at(std::size_t i) { return static_cast<std::uint8_t>(i / 40); }

// The bytes are composed here, without the encoder.
inline replay::CanLog some_log() {
  replay::CanLog log;
  log.channels = {"can0"};
  for (std::size_t i = 0; i < kSomeFrames; ++i) {
    replay::LoggedFrame logged;
    logged.at.ns = kSomeBegin_ns + static_cast<std::int64_t>(i) * 10'000'000;
    logged.frame.id = 16;
    logged.frame.length = 8;
    const auto speed = static_cast<std::uint16_t>(raw_speed_at(i));
    const auto low = static_cast<std::uint8_t>(speed & 0xFFU);
    const auto high = static_cast<std::uint8_t>(speed >> 8U);
    const auto page = static_cast<std::uint8_t>(i % 2);
    logged.frame.data = {low, high, low, high, gear_at(i), page, 7, 0};
    log.frames.push_back(logged);
  }
  return log;
}

}  // namespace pitwall::report

// Names of NovAtel's ASCII logs and their numeric values: logs, solution and position types, INS
// status, datum, clock, time status, ports.
//   in     a number or a name
//   out    the other one; empty if the tables do not have it
//   source OEM7 Commands and Logs Reference Manual: "Solution Status", "Position or Velocity Type",
//          "Inertial Solution Status", "Datum Transformation Parameters", "Clock Model Status",
//          "GPS Reference Time Status", "Detailed Port Identifier"; for INSCONFIG its page in the
//          manual, SETINSPROFILE, and the tables of novatel_oem7_msgs
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "protocol/gnss/field_kind.hpp"

namespace pitwall::gnss {

// For the kinds from kSolution to kTruth. Empty for a number without a name.
std::string_view name_of(Kind kind, std::uint32_t value);
std::optional<std::uint32_t> value_of(Kind kind, std::string_view name);

// Names without the letter of the format: "BESTPOS", 42.
std::string_view log_name(std::uint16_t id);
std::optional<std::uint16_t> log_id(std::string_view name);

std::string_view time_status_name(std::uint8_t status);
std::optional<std::uint8_t> time_status_value(std::string_view name);

// Port name with its virtual port number: COM1_30.
struct PortName {
  std::string_view name;
  unsigned virtual_port = 0;
};
std::optional<PortName> port_name(std::uint8_t port);
std::optional<std::uint8_t> port_value(std::string_view name);

}  // namespace pitwall::gnss

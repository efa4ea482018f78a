// A dissector for Wireshark in Lua: what it knows of fields comes from the registry, what it knows
// of packets is said in packet/header.hpp and packet/body.hpp.
//   use    wireshark -X lua_script:pitwall.lua; the port of the base is a preference. What goes to
//          it comes from the car
//   invariants
//          packets that are signed are shown to the last field; of sealed ones only the clear part.
//          Nothing is verified: it has no keys
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

namespace pitwall::telemetry {

inline constexpr std::uint16_t kDissectorPort = 23'431;  // the base's default

std::string dissector_lua();

}  // namespace pitwall::telemetry

// Generator of the Wireshark dissector in Lua. The fields come from the registry; the packet format
// is that of packet/header.hpp and packet/body.hpp.
//   use    wireshark -X lua_script:pitwall.lua; the port of the base is a preference. Packets to
//          that port come from the car
//   invariants
//          signed packets are shown to the last field, without verification. Sealed packets are
//          opened by the key log if its preference is set; otherwise only the clear part is shown
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

namespace pitwall::telemetry {

inline constexpr std::uint16_t kDissectorPort = 23'431;  // the base's default

std::string dissector_lua();

}  // namespace pitwall::telemetry

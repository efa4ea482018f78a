// Types of a connected client that the parts of the web server share.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bitset>
#include <cstddef>

#include "basestation/publishers/web/admission/identity.hpp"
#include "protocol/telemetry/command/command_table.hpp"

namespace pitwall::publishers::web {

// Client number, which is also its number as holder of the authority. Scripts use lower ones.
using ClientId = telemetry::HolderId;
inline constexpr ClientId kFirstClient = 16, kLastClient = 254;
using ClientSet = std::bitset<256>;
inline constexpr std::size_t kTextMax = 64 * 1'024;  // bytes of one text of a client

}  // namespace pitwall::publishers::web

// Client of the web server: its number, its role, and who it is once it is authenticated.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bitset>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "protocol/telemetry/command/command_table.hpp"

namespace pitwall::publishers::web {

// Client number, which is also its number as holder of the authority. Scripts use lower ones.
using ClientId = telemetry::HolderId;
inline constexpr ClientId kFirstClient = 16, kLastClient = 254;
using ClientSet = std::bitset<256>;
inline constexpr std::size_t kTextMax = 64 * 1'024;  // bytes of one text of a client

enum class Role : std::uint8_t { kViewer, kOperator };
constexpr std::string_view text_of(Role role) {
  return role == Role::kOperator ? "operator" : "viewer";
}

struct Identity {
  Role role = Role::kViewer;
  std::string name{};
  std::string token_id{};  // identifies the token without revealing it; empty without a token
};

}  // namespace pitwall::publishers::web

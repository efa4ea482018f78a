// Identity of an authenticated client.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace pitwall::publishers::web {

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

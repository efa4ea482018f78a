// Access rules of the web services: who is admitted, and in which role.
//   in     the tokens; headers of a request: Host, Origin, a token or a session
//   out    a role and a name; or a refusal
//   invariants
//          a foreign page cannot use the base: an Origin that is not the base's own is refused. So
//          is a Host that is neither an address, nor localhost, nor a configured name; otherwise a
//          foreign name that resolves to this address would pass as the base's own (DNS rebinding).
//          A tool that is a web page of its own may be admitted by its origin
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "basestation/publishers/web/admission/client.hpp"
#include "basestation/publishers/web/admission/token_store.hpp"
#include "protocol/vocabulary/result.hpp"

namespace pitwall::publishers::web {

struct AccessRules {
  std::shared_ptr<TokenStore> tokens = std::make_shared<TokenStore>();
  std::optional<Role> default_role = Role::kViewer;  // without a token; nullopt: refused
  std::vector<std::string> names{};  // of this machine, beside addresses and localhost
  // Origins of foreign pages that are admitted: "https://app.foxglove.dev".
  std::vector<std::string> origins{};
  bool local_pages = false;  // also admit pages from files and from servers on this machine
  bool encrypted = false;    // TLS is done here; otherwise a proxy in front may do it
};

// Header values of a request; empty if absent.
struct Visitor {
  std::string_view host{}, origin{}, token{}, session{};
};

enum class Refused : std::uint8_t { kHost, kOrigin, kToken };
std::string_view text_of(Refused refused);

// A token is checked before a session. An expired session counts as no session.
Result<Identity, Refused> admit(const AccessRules& rules, const Visitor& visitor, UtcTime now);

}  // namespace pitwall::publishers::web

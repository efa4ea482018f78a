// Access rules of the web services: who is admitted, and in which role.
//   in     the tokens; what a browser says of itself: Host, Origin, a token or a session
//   out    a role and a name; or a refusal
//   invariants
//          a page of somebody else cannot speak to the base: an Origin that is not the base's own
//          is refused; so is a Host that is neither an address, nor localhost, nor a name that was
//          given: otherwise a name that points here would make a foreign page the base's own.
//          A tool that is a page of its own may be let in by its origin
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "basestation/publishers/web/admission/identity.hpp"
#include "basestation/publishers/web/admission/token_book.hpp"
#include "protocol/vocabulary/result.hpp"

namespace pitwall::publishers::web {

struct AccessRules {
  std::shared_ptr<TokenBook> tokens = std::make_shared<TokenBook>();
  std::optional<Role> default_role = Role::kViewer;  // without a token; none: nobody comes in
  std::vector<std::string> names{};  // of this machine, beside addresses and localhost
  // Of pages that may speak to this base beside its own: "https://app.foxglove.dev".
  std::vector<std::string> origins{};
  bool local_pages = false;  // also those of files and of servers on the machine itself
  bool encrypted = false;    // by TLS here; without it a proxy before the base may do that
};

// Of a request: the values of its headers, empty where it has none.
struct Visitor {
  std::string_view host{}, origin{}, token{}, session{};
};

enum class Refused : std::uint8_t { kHost, kOrigin, kToken };
std::string_view text_of(Refused refused);

// A token counts before a session. A session that has ended is as none.
Result<Identity, Refused> admit(const AccessRules& rules, const Visitor& visitor, UtcTime now);

}  // namespace pitwall::publishers::web

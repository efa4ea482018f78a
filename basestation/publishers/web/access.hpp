// Who may come in, and as what.
//   in     the file of tokens; what a browser says of itself: Host, Origin, a token
//   out    a role and a name; or a refusal
//   law    a page of somebody else cannot speak to the base: an Origin that is not the base's own
//          is refused; so is a Host that is neither an address, nor localhost, nor a name that was
//          given: otherwise a name that points here would make a foreign page the base's own.
//          A tool that is a page of its own may be let in by its origin
//          the time that a comparison takes does not tell how much of a token was right
//   errors parse(): Problem with file and line
//
//   operator 8f2c41d09b7a4d51 Anna        role, token (16 to 128 letters, digits, - or _), name
//   viewer   77aa0c1be04f43f2 Garage screen
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "basestation/publishers/web/client.hpp"
#include "protocol/vocabulary/result.hpp"

namespace pitwall::publishers::web {

class Tokens {
 public:
  static Result<Tokens, Problem> parse(std::string_view text, const std::string& name);
  std::optional<Identity> find(std::string_view token) const;

 private:
  struct Row {
    std::string token;
    Identity who;
  };
  std::vector<Row> rows_;
};

struct AccessRules {
  Tokens tokens{};
  std::optional<Role> default_role = Role::kViewer;  // without a token; none: nobody comes in
  std::vector<std::string> names{};  // of this machine, beside addresses and localhost
  // Of pages that may speak to this base beside its own: "https://app.foxglove.dev".
  std::vector<std::string> origins{};
  bool local_pages = false;  // also those of files and of servers on the machine itself
};

// Of a request: the values of its headers, empty where it has none.
struct Visitor {
  std::string_view host{}, origin{}, token{};
};

enum class Refused : std::uint8_t { kHost, kOrigin, kToken };
std::string_view text_of(Refused refused);

Result<Identity, Refused> admit(const AccessRules& rules, const Visitor& visitor);

}  // namespace pitwall::publishers::web

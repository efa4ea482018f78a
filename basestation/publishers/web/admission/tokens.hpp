// Tokens of a file, and the sessions that replace a token in the browser after the login.
//   in     the file's text; a token, or the value of a session
//   out    the identity
//   invariants  a session needs no state in the base: another run of the base, or a spare base with
//          the same file, accepts it. It ends at its time, or when its token's line is removed
//          a session reveals neither its token nor how to make another session
//          the duration of a comparison does not reveal how much of a secret was right
//   errors parse(): Problem with file and line
//   source BLAKE2b (RFC 7693) of libsodium: an identifier and a key from each token, an
//          authentication code for each session
//
//   operator 8f2c41d09b7a4d51 Anna        role, token (16 to 128 letters, digits, - or _), name
//   viewer   77aa0c1be04f43f2 Garage screen
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "basestation/publishers/web/admission/client.hpp"
#include "protocol/vocabulary/result.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::publishers::web {

class Tokens {
 public:
  static Result<Tokens, Problem> parse(std::string_view text, const std::string& name);

  std::optional<Identity> find(std::string_view token) const;
  // Makes a session that is valid until `end`; empty: no such token.
  std::string session(std::string_view token, UtcTime end) const;
  std::optional<Identity> find_session(std::string_view value, UtcTime now) const;
  bool knows(std::string_view token_id) const;

 private:
  static constexpr std::size_t kKeyBytes = 32;
  struct Row {
    std::array<std::uint8_t, kKeyBytes> key{};  // derived from the token, which is not stored
    Identity who{};
  };
  const Row* row_of(std::string_view token) const;
  std::vector<Row> rows_;
};

}  // namespace pitwall::publishers::web

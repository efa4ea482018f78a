// Set of the valid tokens: those of a file, which is read again when it has changed. Removing a
// line disconnects the consoles of its token without a restart.
//   invariants
//          threads may share it
//          a file that cannot be read, or has an error, leaves the tokens as they are
//   errors open(), refresh(): Problem with file and line
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>

#include "basestation/publishers/web/admission/tokens.hpp"

namespace pitwall::publishers::web {

class TokenStore {
 public:
  explicit TokenStore(Tokens tokens = {}) : tokens_(std::move(tokens)) {}
  // Problem also if other users can read or change the file.
  static Result<std::shared_ptr<TokenStore>, Problem> open(const std::string& file);

  std::optional<Identity> find(std::string_view token) const;
  std::string session(std::string_view token, UtcTime end) const;
  std::optional<Identity> find_session(std::string_view value, UtcTime now) const;
  // Whether the client's token is still valid; true for a client without a token.
  bool may_stay(const Identity& who) const;

  // Returns true if the file was read again.
  Result<bool, Problem> refresh();

 private:
  // File attributes that show a change.
  struct Mark {
    std::int64_t changed_ns = 0, size = 0;
    std::uint64_t inode = 0;
    bool operator==(const Mark&) const = default;
  };
  static Mark mark_of(const std::string& file);

  mutable std::mutex lock_;
  Tokens tokens_;
  std::string file_;  // empty: no file
  Mark mark_;
};

}  // namespace pitwall::publishers::web

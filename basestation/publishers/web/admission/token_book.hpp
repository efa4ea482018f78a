// Set of the tokens that are valid now: those of a file, read again when it has changed, so that a
// line that is taken away takes its console away without a restart.
//   invariants
//          threads may share it
//          a file that cannot be read, or has a mistake, changes nothing: what held goes on holding
//   errors open(), look_again(): Problem with file and line
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

class TokenBook {
 public:
  explicit TokenBook(Tokens tokens = {}) : tokens_(std::move(tokens)) {}
  // Refused if others may read or change it.
  static Result<std::shared_ptr<TokenBook>, Problem> open(const std::string& file);

  std::optional<Identity> find(std::string_view token) const;
  std::string session(std::string_view token, UtcTime end) const;
  std::optional<Identity> find_session(std::string_view value, UtcTime now) const;
  // Whether who came by this token may stay; who came without one may.
  bool may_stay(const Identity& who) const;

  // True: the file was read again.
  Result<bool, Problem> look_again();

 private:
  // What tells a file from what it was.
  struct Mark {
    std::int64_t changed_ns = 0, size = 0;
    std::uint64_t inode = 0;
    bool operator==(const Mark&) const = default;
  };
  static Mark mark_of(const std::string& file);

  mutable std::mutex lock_;
  Tokens tokens_;
  std::string file_;  // empty: none
  Mark mark_;
};

}  // namespace pitwall::publishers::web

// SPDX-License-Identifier: Apache-2.0
#include "basestation/publishers/web/admission/token_store.hpp"

#include <sys/stat.h>

#include "protocol/transport/file.hpp"

namespace pitwall::publishers::web {
namespace {

Result<Tokens, Problem> read_tokens(const std::string& file) {
  const auto text = transport::read_private_file(file);
  if (!text) return Unexpected{text.error()};
  return Tokens::parse(*text, file);
}

}  // namespace

TokenStore::Mark TokenStore::mark_of(const std::string& file) {
  struct stat seen {};
  if (::stat(file.c_str(), &seen) != 0) return {};
  return {.changed_ns = seen.st_mtim.tv_sec * kNanosecondsPerSecond + seen.st_mtim.tv_nsec,
          .size = seen.st_size,
          .inode = seen.st_ino};
}

Result<std::shared_ptr<TokenStore>, Problem> TokenStore::open(const std::string& file) {
  const Mark mark = mark_of(file);  // before it is read: what changes meanwhile is read again
  auto tokens = read_tokens(file);
  if (!tokens) return Unexpected{tokens.error()};
  auto store = std::make_shared<TokenStore>(*std::move(tokens));
  store->file_ = file;
  store->mark_ = mark;
  return store;
}

std::optional<Identity> TokenStore::find(std::string_view token) const {
  const std::lock_guard hold(lock_);
  return tokens_.find(token);
}

std::string TokenStore::session(std::string_view token, UtcTime end) const {
  const std::lock_guard hold(lock_);
  return tokens_.session(token, end);
}

std::optional<Identity> TokenStore::find_session(std::string_view value, UtcTime now) const {
  const std::lock_guard hold(lock_);
  return tokens_.find_session(value, now);
}

bool TokenStore::may_stay(const Identity& who) const {
  const std::lock_guard hold(lock_);
  return who.token_id.empty() || tokens_.knows(who.token_id);
}

Result<bool, Problem> TokenStore::refresh() {
  if (file_.empty()) return false;
  const Mark mark = mark_of(file_);
  if (mark == mark_) return false;
  mark_ = mark;  // a mistake is told once
  auto tokens = read_tokens(file_);
  if (!tokens) return Unexpected{tokens.error()};
  const std::lock_guard hold(lock_);
  tokens_ = *std::move(tokens);
  return true;
}

}  // namespace pitwall::publishers::web

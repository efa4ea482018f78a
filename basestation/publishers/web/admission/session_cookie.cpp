// SPDX-License-Identifier: Apache-2.0
#include "basestation/publishers/web/admission/session_cookie.hpp"

#include <algorithm>

namespace pitwall::publishers::web {
namespace {

std::string_view value_of(std::string_view cookies, std::string_view name) {
  while (!cookies.empty()) {
    std::string_view pair = cookies.substr(0, cookies.find(';'));
    cookies.remove_prefix(std::min(cookies.size(), pair.size() + 1));
    pair.remove_prefix(std::min(pair.find_first_not_of(' '), pair.size()));
    if (pair.starts_with(name) && pair.size() > name.size() && pair[name.size()] == '=')
      return pair.substr(name.size() + 1);
  }
  return {};
}

// Without the prefix of a secure one.
std::string page_cookie_name(std::uint16_t port) { return "pitwall-pages-" + std::to_string(port); }

std::int64_t lasts_s(std::string_view session) {
  return session.empty() ? 0 : kSessionLasts.ns / kNanosecondsPerSecond;
}

std::string_view either_of(std::string_view cookies, const std::string& secure,
                           const std::string& plain) {
  const std::string_view found = value_of(cookies, secure);
  return found.empty() ? value_of(cookies, plain) : found;
}

}  // namespace

std::string cookie_name(std::uint16_t port, bool secure) {
  return (secure ? "__Host-pitwall-" : "pitwall-") + std::to_string(port);
}

std::string set_cookie(std::uint16_t port, bool secure, std::string_view session) {
  return cookie_name(port, secure) + "=" + std::string{session} +
         "; Path=/; Max-Age=" + std::to_string(lasts_s(session)) + "; HttpOnly; SameSite=Strict" +
         (secure ? "; Secure" : "");
}

std::string_view session_of(std::string_view cookies, std::uint16_t port) {
  return either_of(cookies, cookie_name(port, true), cookie_name(port, false));
}

std::string set_page_cookie(std::uint16_t port, bool secure, std::string_view path,
                            std::string_view session) {
  return (secure ? "__Secure-" : "") + page_cookie_name(port) + "=" + std::string{session} +
         "; Path=" + std::string{path} + "; Max-Age=" + std::to_string(lasts_s(session)) +
         "; HttpOnly; SameSite=Lax" + (secure ? "; Secure" : "");
}

std::string_view page_session_of(std::string_view cookies, std::uint16_t port) {
  return either_of(cookies, "__Secure-" + page_cookie_name(port), page_cookie_name(port));
}

}  // namespace pitwall::publishers::web

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

}  // namespace

std::string cookie_name(std::uint16_t port, bool secure) {
  return (secure ? "__Host-pitwall-" : "pitwall-") + std::to_string(port);
}

std::string set_cookie(std::uint16_t port, bool secure, std::string_view session) {
  const std::int64_t lasts_s = session.empty() ? 0 : kSessionLasts.ns / kNanosecondsPerSecond;
  return cookie_name(port, secure) + "=" + std::string{session} +
         "; Path=/; Max-Age=" + std::to_string(lasts_s) + "; HttpOnly; SameSite=Strict" +
         (secure ? "; Secure" : "");
}

std::string_view session_of(std::string_view cookies, std::uint16_t port) {
  const std::string_view secure = value_of(cookies, cookie_name(port, true));
  return secure.empty() ? value_of(cookies, cookie_name(port, false)) : secure;
}

}  // namespace pitwall::publishers::web

// Session cookie of a browser: scripts cannot read it, and foreign pages cannot make it be sent.
//   source RFC 6265bis: HttpOnly, SameSite=Strict, Secure, the prefixes __Host- and __Secure-
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "protocol/vocabulary/time.hpp"

namespace pitwall::publishers::web {

inline constexpr Duration kSessionLasts = seconds(24 * 3'600);

// Cookies are shared by all ports of a machine, so the port is part of the name. `secure`: sent
// over TLS only.
std::string cookie_name(std::uint16_t port, bool secure);
// Value of the header Set-Cookie. An empty session deletes the cookie.
std::string set_cookie(std::uint16_t port, bool secure, std::string_view session);
// The same session in a cookie for pages below `path` only. A page without an origin of its own is
// foreign to the browser: of what its links open, no strict cookie is sent, and this one is.
std::string set_page_cookie(std::uint16_t port, bool secure, std::string_view path,
                            std::string_view session);
std::string_view page_session_of(std::string_view cookies, std::uint16_t port);
// Session in a request's Cookie header, under the secure or the plain name; empty if absent.
std::string_view session_of(std::string_view cookies, std::uint16_t port);

}  // namespace pitwall::publishers::web

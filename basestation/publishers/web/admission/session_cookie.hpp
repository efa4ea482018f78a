// Session cookie of a browser: scripts cannot read it, and foreign pages cannot make it be sent.
//   source RFC 6265bis: HttpOnly, SameSite=Strict, Secure, the prefix __Host-
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
// Session in a request's Cookie header, under the secure or the plain name; empty if absent.
std::string_view session_of(std::string_view cookies, std::uint16_t port);

}  // namespace pitwall::publishers::web

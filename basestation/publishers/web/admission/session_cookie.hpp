// Session cookie of a browser: no script of a page reads it, no page of somebody else sends it.
//   source RFC 6265bis: HttpOnly, SameSite=Strict, Secure, the prefix __Host-
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "protocol/vocabulary/time.hpp"

namespace pitwall::publishers::web {

inline constexpr Duration kSessionLasts = seconds(24 * 3'600);

// Cookies are shared by all ports of a machine, so the port is part of the name. `secure`: it goes
// over TLS only.
std::string cookie_name(std::uint16_t port, bool secure);
// The value of Set-Cookie. An empty session takes the cookie away.
std::string set_cookie(std::uint16_t port, bool secure, std::string_view session);
// Of a request's Cookie header, by either name; empty: none.
std::string_view session_of(std::string_view cookies, std::uint16_t port);

}  // namespace pitwall::publishers::web

// Address of a datagram's sender or destination. It is opaque to the protocol, which only compares
// it.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace pitwall::telemetry {

struct Address {
  std::uint32_t ip = 0;  // host byte order
  std::uint16_t port = 0;

  constexpr bool operator==(const Address&) const = default;
  constexpr bool known() const { return port != 0; }
};

}  // namespace pitwall::telemetry

// Number of random payloads per message in a comparison with another decoder.
//   in     PITWALL_ORACLE_PAYLOADS, which a long run sets to a larger number
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <cstdlib>

namespace pitwall::can {

inline std::uint64_t oracle_payloads(std::uint64_t quick) {
  const char* const wanted = std::getenv("PITWALL_ORACLE_PAYLOADS");
  const std::uint64_t count = wanted == nullptr ? 0 : std::strtoull(wanted, nullptr, 10);
  return count > quick ? count : quick;
}

}  // namespace pitwall::can

// The hash of a text of the schema.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string_view>

#include "protocol/telemetry/registry/schema.hpp"

namespace pitwall::telemetry {

inline std::uint64_t hash_of(std::string_view text) {
  SchemaHash hash;
  hash(text);
  return hash.value();
}

}  // namespace pitwall::telemetry

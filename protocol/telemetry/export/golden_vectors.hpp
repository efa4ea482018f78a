// Test vectors of the group codec, for independent implementations: for each group the code of
// every field and the encoded bits.
//   form   GROUP CASE NAME=CODE ... HEX; a code k stands for min + k * resolution of the registry,
//          "-" for unset. Bits most significant first, padded with zeros to a whole byte
//   cases  first, last, unset: every field at its first or last code, or unset
//          mixed: a different code in each field
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace pitwall::telemetry {

std::string golden_vectors();

}  // namespace pitwall::telemetry

// Gzip compression of a file in memory, as one gzip member.
//   in     the bytes of a whole file
//   out    the compressed file, without a name or a time: the same bytes give the same file
//   invariants
//          unpack_gzip() restores the bytes
//   errors Problem if zlib has no memory
//   source RFC 1952; zlib
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "protocol/vocabulary/result.hpp"

namespace pitwall::replay {

Result<std::string, Problem> pack_gzip(std::string_view bytes);

}  // namespace pitwall::replay

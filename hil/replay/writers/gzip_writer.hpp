// Bytes packed as one member of a gzip file.
//   in     the bytes of a whole file
//   out    the packed file, without a name or a time: the same bytes give the same file
//   invariants
//          unpack_gzip() gives the bytes back
//   errors Problem where zlib has no memory
//   source RFC 1952; zlib
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "protocol/vocabulary/result.hpp"

namespace pitwall::replay {

Result<std::string, Problem> pack_gzip(std::string_view bytes);

}  // namespace pitwall::replay

// Decompressor of gzip files and zlib streams, with a limit on the output.
//   in     compressed bytes; the largest permitted output
//   out    the decompressed bytes, up to the first damage or the end of a cut file
//   errors `problem`, beside the bytes decompressed before it; `is_cut` if only the end is missing,
//          so that all of these bytes are valid
//   source RFC 1950, RFC 1952; zlib
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace pitwall::replay {

inline constexpr std::size_t kMaxUnpackedBytes = std::size_t{1} << 30;

struct Unpacked {
  std::string bytes;
  std::string problem;  // empty: complete
  std::size_t at = 0;   // compressed bytes that were read
  bool is_cut = false;
};

// Decompresses all members of a gzip file in order; zero bytes after the last one are padding.
Unpacked unpack_gzip(std::string_view packed, std::size_t most = kMaxUnpackedBytes);
// Decompresses one zlib stream.
Unpacked unpack_zlib(std::string_view packed, std::size_t most);

}  // namespace pitwall::replay

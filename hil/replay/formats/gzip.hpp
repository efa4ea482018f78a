// Unpacking of gzip files and zlib streams, bounded.
//   in     packed bytes; the most bytes that may come out
//   out    what was unpacked, up to the first damage or the end of a cut file
//   errors told in `problem` beside what was unpacked until then; `is_cut` where only the end is
//          missing, so that all of it can be trusted
//   source RFC 1950, RFC 1952; zlib
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace pitwall::replay {

inline constexpr std::size_t kMaxUnpackedBytes = std::size_t{1} << 30;

struct Unpacked {
  std::string bytes;
  std::string problem;  // empty: whole
  std::size_t at = 0;   // packed bytes that were read
  bool is_cut = false;
};

// All members of a gzip file, one after the other; zero bytes behind the last one are padding.
Unpacked unpack_gzip(std::string_view packed, std::size_t most = kMaxUnpackedBytes);
// One zlib stream.
Unpacked unpack_zlib(std::string_view packed, std::size_t most);

}  // namespace pitwall::replay

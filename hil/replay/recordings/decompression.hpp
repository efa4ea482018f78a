// Decompression of LZ4 and Zstandard frames, as recorders of ROS 2 write them.
//   in     compressed bytes; for a chunk of MCAP also the original length
//   out    the original bytes
//   errors a text with the reason: another compression, damaged bytes, a length other than
//          announced, more than kMostPlainBytes
//   cost   O(bytes); allocates the output
//   source lz4frame.h of liblz4 1.9.4, zstd.h of libzstd 1.5.4; mcap.dev/spec, "chunk"
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "hil/replay/recordings/byte_pool.hpp"
#include "protocol/vocabulary/result.hpp"

namespace pitwall::traffic {

inline constexpr std::uint64_t kMostPlainBytes = std::uint64_t{1} << 30;

// Decompresses a chunk of MCAP. `compression` is "lz4" or "zstd".
Result<std::string, std::string> decompress_chunk(std::string_view compression, Bytes bytes,
                                                  std::uint64_t plain_bytes);

// For a whole file or a single message, as rosbag2 writes them with "file" and "message"
// compression.
bool is_zstd(Bytes bytes);
Result<std::string, std::string> decompress_zstd(Bytes bytes, std::uint64_t most = kMostPlainBytes);

}  // namespace pitwall::traffic

// Decompression of what recorders of ROS 2 write: LZ4 and Zstandard frames.
//   in     compressed bytes; of a chunk of MCAP also how long they were before
//   out    the bytes as they were
//   errors a text that says what was wrong: another compression, damaged bytes, another length than
//          announced, more than kMostPlainBytes
//   cost   O(bytes); allocates what comes out
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

// A chunk of MCAP. `compression` is "lz4" or "zstd".
Result<std::string, std::string> decompress_chunk(std::string_view compression, Bytes bytes,
                                                  std::uint64_t plain_bytes);

// A whole file or a single message, as rosbag2's "file" and "message" compression write them.
bool is_zstd(Bytes bytes);
Result<std::string, std::string> decompress_zstd(Bytes bytes, std::uint64_t most = kMostPlainBytes);

}  // namespace pitwall::traffic

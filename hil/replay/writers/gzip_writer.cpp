// SPDX-License-Identifier: Apache-2.0
#include "hil/replay/writers/gzip_writer.hpp"

#include <zlib.h>

#include <algorithm>

namespace pitwall::replay {
namespace {

constexpr int kGzipWindow = 15 + 16;
constexpr int kMemoryLevel = 8;  // zlib's default
constexpr std::size_t kStepBytes = std::size_t{1} << 20U;

}  // namespace

Result<std::string, Problem> pack_gzip(std::string_view bytes) {
  z_stream stream{};
  if (deflateInit2(&stream, Z_DEFAULT_COMPRESSION, Z_DEFLATED, kGzipWindow, kMemoryLevel,
                   Z_DEFAULT_STRATEGY) != Z_OK)
    return refuse("gzip", "there is no memory to pack the file");
  std::string out;
  for (int state = Z_OK; state == Z_OK;) {
    const std::string_view step = bytes.substr(stream.total_in, kStepBytes);
    const bool is_last = stream.total_in + step.size() == bytes.size();
    // zlib does not write to its input.
    stream.next_in = const_cast<Bytef*>(reinterpret_cast<const Bytef*>(step.data()));
    stream.avail_in = static_cast<uInt>(step.size());
    out.resize(stream.total_out + deflateBound(&stream, static_cast<uLong>(step.size())));
    stream.next_out = reinterpret_cast<Bytef*>(out.data() + stream.total_out);
    stream.avail_out = static_cast<uInt>(out.size() - stream.total_out);
    state = deflate(&stream, is_last ? Z_FINISH : Z_NO_FLUSH);
  }
  out.resize(stream.total_out);
  deflateEnd(&stream);
  return out;
}

}  // namespace pitwall::replay

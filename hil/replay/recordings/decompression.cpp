// SPDX-License-Identifier: Apache-2.0
#include "hil/replay/recordings/decompression.hpp"

#include <lz4frame.h>
#include <zstd.h>

#include <algorithm>
#include <array>
#include <memory>

namespace pitwall::traffic {
namespace {

constexpr std::array<std::uint8_t, 4> kZstdMagic{0x28, 0xB5, 0x2F, 0xFD};
constexpr std::size_t kPiece = std::size_t{1} << 18;
// No compressor makes more of a byte: 255 for LZ4; blocks of one repeated byte for Zstandard.
constexpr std::uint64_t kMostPerByte = std::uint64_t{1} << 16;

using Text = Result<std::string, std::string>;

Unexpected<std::string> no(std::string why) { return {std::move(why)}; }

struct FreeLz4 {
  void operator()(LZ4F_dctx* context) const { LZ4F_freeDecompressionContext(context); }
};
struct FreeZstd {
  void operator()(ZSTD_DCtx* context) const { ZSTD_freeDCtx(context); }
};

Text decompress_lz4(Bytes bytes, std::uint64_t most) {
  LZ4F_dctx* raw = nullptr;
  if (LZ4F_isError(LZ4F_createDecompressionContext(&raw, LZ4F_VERSION)) != 0)
    return no("no memory to decompress LZ4");
  const std::unique_ptr<LZ4F_dctx, FreeLz4> context{raw};
  std::string plain;
  std::string piece(kPiece, '\0');
  std::size_t more = 1;  // bytes that the frame still expects; 0: it is whole
  while (more != 0) {
    std::size_t out = piece.size(), in = bytes.size();
    more = LZ4F_decompress(context.get(), piece.data(), &out, bytes.data(), &in, nullptr);
    if (LZ4F_isError(more) != 0) return no(std::string{"damaged LZ4: "} + LZ4F_getErrorName(more));
    if (plain.size() + out > most) return no("LZ4 of more bytes than announced");
    plain.append(piece, 0, out);
    bytes = bytes.subspan(in);
    if (more != 0 && out == 0 && bytes.empty()) return no("cut LZ4");
  }
  if (!bytes.empty()) return no("damaged LZ4: bytes behind its end");
  return plain;
}

}  // namespace

Text decompress_chunk(std::string_view compression, Bytes bytes, std::uint64_t plain_bytes) {
  if (plain_bytes > std::min<std::uint64_t>(kMostPlainBytes, bytes.size() * kMostPerByte))
    return no("compressed chunk of an impossible length");
  const bool is_lz4 = compression == "lz4";
  if (!is_lz4 && compression != "zstd") {
    return no("chunk in an unknown compression, expected lz4 or zstd");
  }
  Text plain = is_lz4 ? decompress_lz4(bytes, plain_bytes) : decompress_zstd(bytes, plain_bytes);
  if (plain && plain->size() != plain_bytes)
    return no("compressed chunk with fewer bytes than announced");
  return plain;
}

bool is_zstd(Bytes bytes) {
  return bytes.size() >= kZstdMagic.size() &&
         std::ranges::equal(bytes.first(kZstdMagic.size()), kZstdMagic);
}

Text decompress_zstd(Bytes bytes, std::uint64_t most) {
  const std::unique_ptr<ZSTD_DCtx, FreeZstd> context{ZSTD_createDCtx()};
  if (!context) return no("no memory to decompress Zstandard");
  std::string plain;
  std::string piece(kPiece, '\0');
  ZSTD_inBuffer in{bytes.data(), bytes.size(), 0};
  for (std::size_t more = 1; more != 0 || in.pos < in.size;) {  // frames may follow each other
    ZSTD_outBuffer out{piece.data(), piece.size(), 0};
    const std::size_t before = in.pos;
    more = ZSTD_decompressStream(context.get(), &out, &in);
    if (ZSTD_isError(more) != 0)
      return no(std::string{"damaged Zstandard: "} + ZSTD_getErrorName(more));
    if (plain.size() + out.pos > most)
      return no(most == kMostPlainBytes
                    ? "more than 1 GiB comes out of it: unpack it to a file first: zstd -d FILE"
                    : "Zstandard of more bytes than announced");
    plain.append(piece, 0, out.pos);
    if (more != 0 && out.pos == 0 && in.pos == before) return no("cut Zstandard");
  }
  return plain;
}

}  // namespace pitwall::traffic

// SPDX-License-Identifier: Apache-2.0
#include "hil/replay/recordings/decompression.hpp"

#include <gtest/gtest.h>
#include <lz4frame.h>
#include <zstd.h>

#include "tests/hil/replay/recordings/recording_samples.hpp"

namespace pitwall::traffic {
namespace {

std::string plain_text() {
  std::string text;
  for (int i = 0; i < 40'000; ++i) text += std::to_string(i * i % 977) + ",";
  return text;
}

std::string as_lz4(const std::string& plain) {
  std::string packed(LZ4F_compressFrameBound(plain.size(), nullptr), '\0');
  packed.resize(
      LZ4F_compressFrame(packed.data(), packed.size(), plain.data(), plain.size(), nullptr));
  return packed;
}

std::string as_zstd(const std::string& plain) {
  std::string packed(ZSTD_compressBound(plain.size()), '\0');
  packed.resize(ZSTD_compress(packed.data(), packed.size(), plain.data(), plain.size(), 3));
  return packed;
}

TEST(Decompression, GivesTheBytesAsTheyWere) {
  for (const std::string& plain : {std::string{}, std::string{"a"}, plain_text()}) {
    const auto lz4 = decompress_chunk("lz4", as_bytes(as_lz4(plain)), plain.size());
    const auto zstd = decompress_chunk("zstd", as_bytes(as_zstd(plain)), plain.size());
    ASSERT_TRUE(lz4) << lz4.error();
    ASSERT_TRUE(zstd) << zstd.error();
    EXPECT_EQ(*lz4, plain);
    EXPECT_EQ(*zstd, plain);
  }
  EXPECT_EQ(*decompress_zstd(as_bytes(as_zstd("a") + as_zstd("b"))), "ab");
}

TEST(Decompression, RefusesAnotherLengthThanAnnounced) {
  const std::string plain = plain_text(), lz4 = as_lz4(plain), zstd = as_zstd(plain);
  for (const std::int64_t more : {-1, 1}) {
    const auto announced =
        static_cast<std::uint64_t>(static_cast<std::int64_t>(plain.size()) + more);
    EXPECT_FALSE(decompress_chunk("lz4", as_bytes(lz4), announced)) << more;
    EXPECT_FALSE(decompress_chunk("zstd", as_bytes(zstd), announced)) << more;
  }
  EXPECT_FALSE(decompress_chunk("lz4", as_bytes(lz4), ~std::uint64_t{0}));
  EXPECT_FALSE(decompress_zstd(as_bytes(zstd), plain.size() - 1));
}

TEST(Decompression, RefusesEveryCut) {
  const std::string plain(2'000, 'x'), lz4 = as_lz4(plain), zstd = as_zstd(plain);
  for (std::size_t n = 0; n < lz4.size(); ++n)
    EXPECT_FALSE(decompress_chunk("lz4", as_bytes(lz4.substr(0, n)), plain.size())) << n;
  for (std::size_t n = 0; n < zstd.size(); ++n)
    EXPECT_FALSE(decompress_chunk("zstd", as_bytes(zstd.substr(0, n)), plain.size())) << n;
}

TEST(Decompression, DamagedBytesNeverCrash) {
  testing::Dice dice{4};
  const std::string plain = plain_text(), lz4 = as_lz4(plain), zstd = as_zstd(plain);
  for (int i = 0; i < 400; ++i) {
    const auto a = decompress_chunk("lz4", as_bytes(testing::damaged(lz4, dice)), plain.size());
    const auto b = decompress_chunk("zstd", as_bytes(testing::damaged(zstd, dice)), plain.size());
    for (const auto& result : {a, b}) {
      if (result) {
        EXPECT_EQ(result->size(), plain.size());
      } else {
        EXPECT_FALSE(result.error().empty());
      }
    }
  }
}

TEST(Decompression, NamesWhatItKnows) {
  const auto unknown = decompress_chunk("snappy", as_bytes("abc"), 3);
  ASSERT_FALSE(unknown);
  EXPECT_EQ(unknown.error(), "chunk in an unknown compression, expected lz4 or zstd");
  EXPECT_TRUE(is_zstd(as_bytes(as_zstd("x"))));
  EXPECT_FALSE(is_zstd(as_bytes(as_lz4("x"))));
  EXPECT_FALSE(is_zstd({}));
}

}  // namespace
}  // namespace pitwall::traffic

// SPDX-License-Identifier: Apache-2.0
#include "protocol/bits/sha256.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

namespace pitwall::bits {
namespace {

std::vector<std::uint8_t> bytes_of(std::string_view text) { return {text.begin(), text.end()}; }

std::string digest_of(std::span<const std::uint8_t> bytes) {
  Sha256 hash;
  hash.update(bytes);
  return to_hex(hash.digest());
}

TEST(Sha256, VectorsOfTheStandard) {  // FIPS 180-2 appendix B; NIST CAVP
  EXPECT_EQ(digest_of({}), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(digest_of(bytes_of("abc")),
            "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(digest_of(bytes_of("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq")),
            "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
  EXPECT_EQ(digest_of(std::vector<std::uint8_t>(1'000'000, 'a')),
            "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

TEST(Sha256, AgreesWithSha256sumAtEveryLengthAroundABlock) {
  const auto path = std::filesystem::path{::testing::TempDir()} / "pitwall_sha256_input";
  for (const std::size_t length :
       {0U, 1U, 54U, 55U, 56U, 57U, 63U, 64U, 65U, 119U, 120U, 127U, 128U, 129U, 999U}) {
    std::vector<std::uint8_t> bytes(length);
    for (std::size_t i = 0; i < length; ++i) bytes[i] = static_cast<std::uint8_t>(i * 131 + length);
    std::ofstream{path, std::ios::binary}.write(reinterpret_cast<const char*>(bytes.data()),
                                                static_cast<std::streamsize>(length));
    FILE* pipe = popen(("sha256sum <'" + path.string() + "'").c_str(), "r");
    ASSERT_NE(pipe, nullptr);
    std::string line(64, ' ');
    EXPECT_EQ(std::fread(line.data(), 1, line.size(), pipe), line.size());
    EXPECT_EQ(pclose(pipe), 0);
    EXPECT_EQ(digest_of(bytes), line) << length;
  }
}

TEST(Sha256, PiecesGiveWhatTheWholeGivesAndAskingChangesNothing) {
  std::vector<std::uint8_t> bytes(300);
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<std::uint8_t>(i);
  for (std::size_t piece = 1; piece < 130; ++piece) {
    Sha256 hash;
    for (std::size_t at = 0; at < bytes.size(); at += piece) {
      hash.update(std::span{bytes}.subspan(at, std::min(piece, bytes.size() - at)));
      static_cast<void>(hash.digest());
    }
    EXPECT_EQ(to_hex(hash.digest()), digest_of(bytes)) << piece;
  }
}

}  // namespace
}  // namespace pitwall::bits

// SPDX-License-Identifier: Apache-2.0
// Against the vectors of the standards.
#include "protocol/telemetry/session/crypto/cipher.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <new>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/vocabulary/bytes.hpp"
#include "tests/protocol/telemetry/session/hex_of.hpp"

namespace pitwall::telemetry {
namespace {

// RFC 7693, appendix A.
TEST(Cipher, HashesAsInTheStandard) {
  constexpr std::string_view kAbc =
      "ba80a53f981c4d0d6a2797b69f12f6e94c212f14685ac4b74b12bb6fdbffa2d1"
      "7d87c5392aab792dc252d5de4533cc9518d38aa8dbf1925ab92386edd4009923";
  EXPECT_EQ(hex_of(hash_of({as_bytes("abc")}).span()), kAbc);
  EXPECT_EQ(hex_of(hash_of({as_bytes("a"), as_bytes(""), as_bytes("bc")}).span()), kAbc);
}

// RFC 7748, 6.1.
TEST(Cipher, AgreesAsInTheStandard) {
  const auto key = [](std::string_view hex) { return *parse_public_key(hex, "RFC 7748"); };
  const Key bob(key("5dab087e624a8a4b79e17f8b83800ee66f3bb1292618b6fd1c2f8b27ff88e0eb"));
  const PublicKey alice = key("8520f0098930a754748b7ddcb43ef75a0dbf3a0d26381af4eba4a98eaa9b4e6a");
  EXPECT_EQ(text_of(public_of(bob)),
            "de9edb7d7b7dc1b4d35b61c2ece435373f8343c85b78674dadfc7e146f882b4f");
  Key shared;
  ASSERT_TRUE(agree(bob, alice, shared));
  EXPECT_EQ(hex_of(shared.span()),
            "4a5d9d5ba4ce2de1728e3bf480350f25e07e21c947d19e3376f09b3c1e161742");
}

TEST(Cipher, APointOfSmallOrderIsRefused) {
  Key shared;
  EXPECT_FALSE(agree(Key(PublicKey{1, 2, 3}), PublicKey{}, shared));
  EXPECT_FALSE(agree(Key(PublicKey{1, 2, 3}), PublicKey{1}, shared));
}

TEST(Cipher, OpensWhatItSealedAndNothingElse) {
  const Key key(PublicKey{1}), other(PublicKey{2});
  const std::vector<std::uint8_t> plain(50, 7);
  std::vector<std::uint8_t> sealed(plain.size() + kTagSize), opened(plain.size());
  aead_seal(key, 9, as_bytes("clear"), plain, sealed);
  EXPECT_TRUE(aead_open(key, 9, as_bytes("clear"), sealed, opened));
  EXPECT_EQ(opened, plain);
  EXPECT_FALSE(aead_open(key, 10, as_bytes("clear"), sealed, opened));
  EXPECT_FALSE(aead_open(key, 9, as_bytes("other"), sealed, opened));
  EXPECT_FALSE(aead_open(other, 9, as_bytes("clear"), sealed, opened));
}

TEST(Cipher, DerivedKeysDifferByPurpose) {
  const Key key(PublicKey{1});
  EXPECT_EQ(derive(key, as_bytes("a")).bytes, derive(key, as_bytes("a")).bytes);
  EXPECT_NE(derive(key, as_bytes("a")).bytes, derive(key, as_bytes("b")).bytes);
  EXPECT_NE(derive(key, as_bytes("a")).bytes, key.bytes);
  EXPECT_NE(keyed_tag(key, {as_bytes("a")}), keyed_tag(key, {as_bytes("b")}));
}

TEST(Secret, IsOverwrittenWhenItEnds) {
  alignas(Secret<32>) std::array<std::byte, sizeof(Secret<32>)> place{};
  auto* const secret = new (place.data()) Secret<32>();
  secret->bytes.fill(0xAA);
  secret->~Secret();
  EXPECT_EQ(std::count(place.begin(), place.end(), std::byte{0xAA}), 0);
}

}  // namespace
}  // namespace pitwall::telemetry

// SPDX-License-Identifier: Apache-2.0
// Against the vectors of the cacophony library, with which implementations of Noise are checked.
#include "protocol/telemetry/session/crypto/noise_kk.hpp"

#include <gtest/gtest.h>

#include <string>
#include <string_view>
#include <vector>

#include "tests/protocol/telemetry/session/hex_of.hpp"

namespace pitwall::telemetry {
namespace {

std::vector<std::uint8_t> bytes_of_hex(std::string_view hex) {
  std::vector<std::uint8_t> bytes;
  for (std::size_t i = 0; i + 1 < hex.size(); i += 2) {
    bytes.push_back(
        static_cast<std::uint8_t>(std::stoi(std::string(hex.substr(i, 2)), nullptr, 16)));
  }
  return bytes;
}

Key key_of_hex(std::string_view hex) {
  const auto bytes = bytes_of_hex(hex);
  Key key;
  std::copy(bytes.begin(), bytes.end(), key.bytes.begin());
  return key;
}

Identity identity_of_hex(std::string_view secret) {
  Identity identity;
  identity.secret_key = key_of_hex(secret);
  identity.public_key = public_of(identity.secret_key);
  return identity;
}

constexpr std::string_view kInitiatorStatic =
    "e61ef9919cde45dd5f82166404bd08e38bceb5dfdfded0a34c8df7ed542214d1";
constexpr std::string_view kResponderStatic =
    "4a3acbfdb163dec651dfa3194dece676d437029c62a408b4c5ea9114246e4893";
constexpr std::string_view kInitiatorEphemeral =
    "893e28b9dc6ca8d611ab664754b8ceb7bac5117349a4439a6b0569da977c464a";
constexpr std::string_view kResponderEphemeral =
    "bbdb4cdbd309f1a1f2e1456967fe288cadd6f712d65dc7b7793d5e63da6b375b";

struct Message {
  std::string_view payload, wire;
};
constexpr Message kOpening{"4c756477696720766f6e204d69736573",
                           "ca35def5ae56cec33dc2036731ab14896bc4c75dbb07a61f879f8e3afa4c7944"
                           "f79a1d4b21fc3ea4a0c87213b8b4f05921228879fb74ea0d39ffc64619dc9658"};
constexpr Message kAnswer{"4d757272617920526f746862617264",
                          "95ebc60d2b1fa672c1f46a8aa265ef51bfe38e7ccb39ec5be34069f144808843"
                          "e20b1bf85731f75d7e21b5d54baaa6a1dd8690bb26b34c92c02b152d726c01"};
constexpr std::string_view kTranscript =
    "449b8bddaf3d2f8999318d213d1db80a90d373bac67ce7aafcc444fc895414a9"
    "7e82fb7797b2ae85f29199856789e9b8aef2a58faa828267ba4f2b09d89692d3";
constexpr std::string_view kVectorPrologue = "50726f6c6f677565313233";  // Prologue123
// The same keys and payloads with another prologue.
constexpr std::string_view kOtherPrologue = "4a6f686e2047616c74";  // John Galt
constexpr std::string_view kOtherTranscript =
    "76dbc866183c8ee7363dbf0ebab8d6355010245f9817aa78359818a03a052586"
    "d7e8b4bb2ae5622a1a61212df90af04bb2b2cc189ce0e819ba0c4970c9f71805";

struct Parties {
  Identity initiator = identity_of_hex(kInitiatorStatic);
  Identity responder = identity_of_hex(kResponderStatic);
  std::vector<std::uint8_t> prologue = bytes_of_hex(kVectorPrologue);
  NoiseKk a{NoiseKk::Side::kInitiator, initiator, responder.public_key, prologue};
  NoiseKk b{NoiseKk::Side::kResponder, responder, initiator.public_key, prologue};
};

// One message from `from` to `to`, compared with the vector.
void pass(NoiseKk& from, NoiseKk& to, const Key& ephemeral, const Message& message) {
  const auto payload = bytes_of_hex(message.payload);
  std::vector<std::uint8_t> wire(payload.size() + kNoiseOverhead), read(payload.size());
  ASSERT_TRUE(from.write(ephemeral, payload, wire));
  EXPECT_EQ(hex_of(wire), message.wire);
  ASSERT_TRUE(to.read(wire, read));
  EXPECT_EQ(hex_of(read), message.payload);
}

std::string sealed(const Key& key, std::uint64_t number, std::string_view payload) {
  const auto plain = bytes_of_hex(payload);
  std::vector<std::uint8_t> out(plain.size() + kTagSize);
  aead_seal(key, number, {}, plain, out);
  return hex_of(out);
}

TEST(NoiseKk, WritesTheMessagesOfThePublicVectors) {
  Parties p;
  pass(p.a, p.b, key_of_hex(kInitiatorEphemeral), kOpening);
  pass(p.b, p.a, key_of_hex(kResponderEphemeral), kAnswer);
  EXPECT_EQ(hex_of(p.a.transcript().span()), kTranscript);
  EXPECT_EQ(hex_of(p.b.transcript().span()), kTranscript);
  const NoiseKk::Keys keys = p.a.split();
  EXPECT_EQ(keys.from_initiator.bytes, p.b.split().from_initiator.bytes);
  EXPECT_EQ(keys.from_responder.bytes, p.b.split().from_responder.bytes);
  EXPECT_EQ(sealed(keys.from_initiator, 0, "462e20412e20486179656b"),
            "25bfaa58833b07cdd6af7c07f2c51daac681a8ac0a02dd373259bd");
  EXPECT_EQ(sealed(keys.from_responder, 0, "4361726c204d656e676572"),
            "ef586cff556dec8ef0053871ff0d4bf3f2c72e842487ec6d1da69f");
  EXPECT_EQ(sealed(keys.from_initiator, 1, "4a65616e2d426170746973746520536179"),
            "3265d50513550a354425d0218ba1e5f25d4994ce8990e6964398dba5982dbcbd85");
  EXPECT_EQ(sealed(keys.from_responder, 1, "457567656e2042f6686d20766f6e2042617765726b"),
            "f11c02d5c3223d7b9281b52e1b134962b91bc3bfbd1646354dab9fc19b66bf6c1e0a6f431e");
}

TEST(NoiseKk, ThePrologueIsPartOfTheTranscriptAsInThePublicVectors) {
  Parties p{.prologue = bytes_of_hex(kOtherPrologue)};
  const auto first = bytes_of_hex(kOpening.payload), second = bytes_of_hex(kAnswer.payload);
  std::vector<std::uint8_t> opening(first.size() + kNoiseOverhead), read(first.size());
  ASSERT_TRUE(p.a.write(key_of_hex(kInitiatorEphemeral), first, opening));
  ASSERT_TRUE(p.b.read(opening, read));
  std::vector<std::uint8_t> answer(second.size() + kNoiseOverhead);
  ASSERT_TRUE(p.b.write(key_of_hex(kResponderEphemeral), second, answer));
  EXPECT_EQ(hex_of(p.b.transcript().span()), kOtherTranscript);
}

TEST(NoiseKk, RefusesEveryMessageThatDiffersInOneBit) {
  const auto wire = bytes_of_hex(kOpening.wire);
  std::vector<std::uint8_t> payload(wire.size() - kNoiseOverhead);
  for (std::size_t bit = 0; bit < 8 * wire.size(); ++bit) {
    auto changed = wire;
    changed[bit / 8] = static_cast<std::uint8_t>(changed[bit / 8] ^ 1U << bit % 8);
    Parties p;
    EXPECT_FALSE(p.b.read(changed, payload)) << "bit " << bit;
  }
}

TEST(NoiseKk, RefusesAPublicKeyThatGivesNoSecret) {
  auto wire = bytes_of_hex(kOpening.wire);
  std::fill_n(wire.begin(), kKeySize, std::uint8_t{0});
  std::vector<std::uint8_t> payload(wire.size() - kNoiseOverhead);
  Parties p;
  EXPECT_FALSE(p.b.read(wire, payload));
}

TEST(NoiseKk, AnotherPrologueOrAnotherKeyDoesNotFit) {
  const auto wire = bytes_of_hex(kOpening.wire);
  std::vector<std::uint8_t> payload(wire.size() - kNoiseOverhead);
  const Parties p;
  NoiseKk other_prologue{NoiseKk::Side::kResponder, p.responder, p.initiator.public_key,
                         bytes_of_hex(kOtherPrologue)};
  EXPECT_FALSE(other_prologue.read(wire, payload));
  NoiseKk other_peer{NoiseKk::Side::kResponder, p.responder, p.responder.public_key, p.prologue};
  EXPECT_FALSE(other_peer.read(wire, payload));
}

}  // namespace
}  // namespace pitwall::telemetry

// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/session/crypto/keys.hpp"

#include <gtest/gtest.h>

#include <string>

#include "tests/protocol/telemetry/session/rig.hpp"

namespace pitwall::telemetry::testing {
namespace {

TEST(KeyFile, ReadsWhatItWrites) {
  const KeyPair pair = make_pair(4);
  KeyFile of_the_bench = pair.car;
  of_the_bench.bench = true;
  for (const KeyFile& keys : {pair.car, pair.base, of_the_bench}) {
    const auto read = parse_key_file(text_of(keys), "k", {.role = keys.role});
    ASSERT_TRUE(read) << to_string(read.error());
    EXPECT_EQ(read->role, keys.role);
    EXPECT_EQ(read->own.public_key, keys.own.public_key);
    EXPECT_EQ(read->own.secret_key.bytes, keys.own.secret_key.bytes);
    EXPECT_EQ(read->peer, keys.peer);
    EXPECT_EQ(read->bench, keys.bench);
  }
  EXPECT_NE(text_of(pair.car).find("\nrole: car\n"), std::string::npos);
}

TEST(KeyFile, EveryMistakeIsNamedWithItsPlaceAndShowsNoSecret) {
  const KeyPair pair = make_pair(4);
  const std::string good = text_of(pair.base);
  const std::string secret = good.substr(good.find("secret: ") + 8, 64);
  const auto changed = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    return text.replace(text.find(from), from.size(), to);
  };
  const struct {
    std::string text, place, what;
  } cases[] = {
      {"", "k", "has no line role:"},
      {changed("role: base", "role: pit"), "k:2", "role: car or base"},
      {changed("role: base", "role: base\nrole: base"), "k:3", "role: occurs twice"},
      {changed("peer", "friend"), "k:5", "expected one of: role:, public:, secret:, peer:, use:"},
      {changed("secret: ", "secret: 0"), "k:4", "expected 64 hexadecimal digits"},
      {changed("secret: " + secret.substr(0, 1), "secret: x"), "k:4",
       "expected 64 hexadecimal digits"},
      {changed(text_of(pair.base.own.public_key), text_of(pair.car.own.public_key)), "k:3",
       "does not belong to secret:"},
      {changed("role: base", "role: car"), "k:2",
       "these are the car's keys, expected the base's: give base.keys"},
      {changed(text_of(pair.base.peer), text_of(pair.base.own.public_key)), "k:5",
       "is the own key, expected the public: of the other end's file: make both with "
       "`pitwall-base keygen`"},
      {good + "something else\n", "k:6", "expected one of: role:, public:, secret:, peer:, use:"},
      {good + "use: race\n", "k:6", "use: bench, or no such line"},
  };
  for (const auto& c : cases) {
    const auto read = parse_key_file(c.text, "k", {.role = Role::kBase});
    ASSERT_FALSE(read) << c.what;
    EXPECT_EQ(read.error().place, c.place);
    EXPECT_EQ(read.error().what, c.what);
    EXPECT_EQ(to_string(read.error()).find(secret.substr(1, 20)), std::string::npos);
  }
}

// RFC 7748 section 6.1: whatever the own secret, these give the same to everybody. The list is that
// of D. J. Bernstein, https://cr.yp.to/ecdh.html#validate; each also with bit 255, which means
// nothing.
TEST(KeyFile, APeerThatGivesNoSharedSecretIsRefused) {
  const KeyPair pair = make_pair(4);
  const std::string zeros(64, '0'), last = "ffffffffffffffffffffffffffffffffffffffffffffffffffff";
  const std::string points[] = {
      zeros,
      "01" + zeros.substr(2),
      "e0eb7a7c3b41b8ae1656e3faf19fc46ada098deb9c32b1fd866205165f49b800",
      "5f9c95bca3508c24b1d0b1559c83ef5b04445cc4581c8e86d8224eddd09f1157",
      "ecffffffff" + last + "7f",
      "edffffffff" + last + "7f",
      "eeffffffff" + last + "7f",
  };
  for (const KeyFile& keys : {pair.car, pair.base}) {
    for (const std::string& point : points) {
      PublicKey peer = *parse_public_key(point, "point");
      for (int bit = 0; bit < 2; ++bit, peer.back() ^= 0x80) {
        KeyFile wrong = keys;
        wrong.peer = peer;
        const auto read = parse_key_file(text_of(wrong), "k", {.role = keys.role});
        ASSERT_FALSE(read) << point;
        EXPECT_EQ(read.error().place, "k:5");
        EXPECT_NE(read.error().what.find("gives no shared secret"), std::string::npos)
            << read.error().what;
      }
    }
  }
}

TEST(KeyFile, TheOwnKeyIsNoPeerInAnyOfItsSpellings) {
  KeyFile keys = make_pair(4).car;
  keys.peer = keys.own.public_key;
  keys.peer.back() ^= 0x80;
  const auto read = parse_key_file(text_of(keys), "k", {.role = Role::kCar});
  ASSERT_FALSE(read);
  EXPECT_TRUE(read.error().what.starts_with("is the own key")) << read.error().what;
}

TEST(KeyFile, ARealCarTakesNoKeysOfABench) {
  KeyFile keys = make_pair(4).car;
  EXPECT_TRUE(parse_key_file(text_of(keys), "k", {.role = Role::kCar, .real_car = true}));
  keys.bench = true;
  EXPECT_TRUE(parse_key_file(text_of(keys), "k", {.role = Role::kCar}));
  const auto read = parse_key_file(text_of(keys), "k", {.role = Role::kCar, .real_car = true});
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().place, "k:6");
  EXPECT_NE(read.error().what.find("keys of a bench"), std::string::npos);
  EXPECT_NE(read.error().what.find("pitwall-base keygen"), std::string::npos);
}

}  // namespace
}  // namespace pitwall::telemetry::testing

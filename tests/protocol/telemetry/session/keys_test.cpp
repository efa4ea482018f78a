// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/session/keys.hpp"

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
    const auto read = parse_key_file(text_of(keys), "k");
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
      {changed("role: base", "role: base\nrole: base"), "k:3", "a second role:"},
      {changed("peer", "friend"), "k:5", "not one of role:, public:, secret:, peer:, use:"},
      {changed("secret: ", "secret: 0"), "k:4", "a key is 64 hexadecimal digits"},
      {changed("secret: " + secret.substr(0, 1), "secret: x"), "k:4",
       "a key is 64 hexadecimal digits"},
      {changed(text_of(pair.base.own.public_key), text_of(pair.car.own.public_key)), "k:3",
       "does not belong to secret:"},
      {changed(text_of(pair.base.peer), text_of(pair.base.own.public_key)), "k:5",
       "is the own key"},
      {good + "something else\n", "k:6", "not one of role:, public:, secret:, peer:, use:"},
      {good + "use: race\n", "k:6", "use: bench, or no such line"},
  };
  for (const auto& c : cases) {
    const auto read = parse_key_file(c.text, "k");
    ASSERT_FALSE(read) << c.what;
    EXPECT_EQ(read.error().place, c.place);
    EXPECT_EQ(read.error().what, c.what);
    EXPECT_EQ(to_string(read.error()).find(secret.substr(1, 20)), std::string::npos);
  }
}

}  // namespace
}  // namespace pitwall::telemetry::testing

// SPDX-License-Identifier: Apache-2.0
#include "basestation/publishers/web/admission/access.hpp"

#include <gtest/gtest.h>

namespace pitwall::publishers::web {
namespace {

constexpr const char* kFile =
    "# people\n\noperator 8f2c41d09b7a4d51 Anna B.\r\nviewer 77aa0c1be04f43f2 Garage\n";

constexpr UtcTime kNow{1'700'000'000'000'000'000};

Result<Identity, Refused> admit(const AccessRules& rules, const Visitor& visitor) {
  return web::admit(rules, visitor, kNow);
}

AccessRules rules() {
  return {.tokens = std::make_shared<TokenStore>(*Tokens::parse(kFile, "tokens")),
          .default_role = Role::kViewer,
          .names = {"pit.local"}};
}

TEST(Access, ATokenSaysWhoComes) {
  const auto who = admit(rules(), {.host = "127.0.0.1:8080", .token = "8f2c41d09b7a4d51"});
  ASSERT_TRUE(who);
  EXPECT_EQ(who->role, Role::kOperator);
  EXPECT_EQ(who->name, "Anna B.");
  EXPECT_EQ(admit(rules(), {.host = "127.0.0.1:8080"})->role, Role::kViewer);
}

TEST(Access, AWrongTokenIsNoVisitorWithoutOne) {
  for (const char* token :
       {"8f2c41d09b7a4d52", "8f2c41d09b7a4d5", "8f2c41d09b7a4d518f2c41d09b7a4d51"}) {
    const auto who = admit(rules(), {.host = "localhost", .token = token});
    ASSERT_FALSE(who) << token;
    EXPECT_EQ(who.error(), Refused::kToken);
  }
}

TEST(Access, WhereTokensBindNobodyComesWithoutOne) {
  AccessRules bound = rules();
  bound.default_role.reset();
  const auto who = admit(bound, {.host = "localhost"});
  ASSERT_FALSE(who);
  EXPECT_EQ(who.error(), Refused::kToken);
  EXPECT_TRUE(admit(bound, {.host = "localhost", .token = "77aa0c1be04f43f2"}));
}

TEST(Access, OnlyThePageOfTheBaseItselfMaySpeak) {
  EXPECT_TRUE(admit(rules(), {.host = "localhost:80", .origin = "http://localhost:80"}));
  for (const char* origin : {"http://evil.com", "http://localhost:81", "https://localhost:81",
                             "null", "http://localhost:80.evil.com"}) {
    const auto who = admit(rules(), {.host = "localhost:80", .origin = origin});
    ASSERT_FALSE(who) << origin;
    EXPECT_EQ(who.error(), Refused::kOrigin);
  }
}

TEST(Access, ANameThatPointsHereDoesNotMakeAForeignPageOurs) {
  for (const char* host :
       {"evil.com", "evil.com:8080", "127.0.0.1.evil.com", "", "localhost.evil"}) {
    const std::string origin = std::string{"http://"} + host;
    const auto who = admit(rules(), {.host = host, .origin = origin});
    ASSERT_FALSE(who) << host;
    EXPECT_EQ(who.error(), Refused::kHost);
  }
  for (const char* host : {"10.1.2.3:8080", "[::1]:8080", "LOCALHOST", "pit.local:8080"}) {
    EXPECT_TRUE(admit(rules(), {.host = host})) << host;
  }
}

TEST(Access, AToolsPageIsLetInByItsOriginOrFromThisMachine) {
  AccessRules own = rules();
  const auto comes = [&own](std::string_view origin) {
    return admit(own, {.host = "127.0.0.1:8765", .origin = origin}).has_value();
  };
  EXPECT_FALSE(comes("https://app.foxglove.dev"));
  own.origins = {"https://app.foxglove.dev"};
  EXPECT_TRUE(comes("https://APP.foxglove.dev"));
  EXPECT_FALSE(comes("https://app.foxglove.dev.evil.com"));
  EXPECT_FALSE(comes("http://localhost:8080"));
  own.local_pages = true;
  for (const char* origin : {"http://localhost:8080", "https://localhost", "http://127.0.0.1:1",
                             "http://[::1]:3000", "file://"}) {
    EXPECT_TRUE(comes(origin)) << origin;
  }
  for (const char* origin : {"http://localhost.evil.com", "http://127.0.0.1.evil.com", "null",
                             "http://10.1.2.3", "ftp://localhost", "http://"}) {
    EXPECT_FALSE(comes(origin)) << origin;
  }
}

TEST(Access, ASessionSaysWhoComesAsItsTokenDoes) {
  const AccessRules bound = rules();
  const std::string session =
      bound.tokens->session("8f2c41d09b7a4d51", UtcTime{kNow.ns + seconds(60).ns});
  const auto who = admit(bound, {.host = "localhost", .session = session});
  ASSERT_TRUE(who);
  EXPECT_EQ(who->name, "Anna B.");
  const auto viewer =
      admit(bound, {.host = "localhost", .token = "77aa0c1be04f43f2", .session = session});
  EXPECT_EQ(viewer->name, "Garage") << "a token counts before it";
  const auto later = web::admit(bound, {.host = "localhost", .session = session},
                                UtcTime{kNow.ns + seconds(60).ns});
  EXPECT_EQ(later->name, "") << "one that has ended is as none";
}

TEST(Access, APageOfTlsOnlySpeaksWhereThereIsTls) {
  AccessRules own = rules();
  EXPECT_TRUE(admit(own, {.host = "pit.local", .origin = "http://pit.local"}));
  own.encrypted = true;
  EXPECT_FALSE(admit(own, {.host = "pit.local", .origin = "http://pit.local"}));
  EXPECT_TRUE(admit(own, {.host = "pit.local", .origin = "https://pit.local"}));
}

}  // namespace
}  // namespace pitwall::publishers::web

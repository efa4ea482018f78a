// SPDX-License-Identifier: Apache-2.0
#include "basestation/publishers/web/http_responder.hpp"

#include <gtest/gtest.h>

#include "protocol/transport/file.hpp"

namespace pitwall::publishers::web {
namespace {

constexpr const char *kOperator = "8f2c41d09b7a4d51", *kViewer = "77aa0c1be04f43f2";

HttpConfig config(std::string layouts = {}) {
  const std::string file =
      std::string{"operator "} + kOperator + " Anna\nviewer " + kViewer + " G\n";
  return {.access = {.tokens = *Tokens::parse(file, "tokens")},
          .console = "/nowhere",
          .documents = {{"/api/track", "{}"}},
          .layouts = std::move(layouts)};
}

HttpQuestion get(std::string_view target) {
  return {.method = "GET", .target = target, .host = "localhost:8080"};
}
HttpQuestion put(std::string_view target, std::string_view body) {
  return {.method = "PUT", .target = target, .host = "localhost:8080", .body = body};
}

TEST(HttpResponder, AConsoleThatIsNotBuiltIsSaid) {
  HttpResponder desk(config());
  const HttpAnswer answer = desk.answer(get("/"));
  EXPECT_EQ(answer.status, 200u);
  EXPECT_NE(answer.body->find("--console-dir"), std::string::npos);
  EXPECT_NE(answer.policy.find("default-src 'self'"), std::string::npos);
  EXPECT_EQ(answer.policy.find("unsafe"), std::string::npos);
}

TEST(HttpResponder, WhatIsNotThereOrNotAllowedIsRefusedWithALine) {
  HttpResponder desk(config());
  EXPECT_EQ(desk.answer(get("/nothing")).status, 404u);
  EXPECT_EQ(desk.answer(get("/api/layouts/none")).status, 204u);
  EXPECT_EQ(desk.answer(get("/api/layouts/../keys")).status, 404u);
  EXPECT_EQ(desk.answer(put("/api/track", "{}")).status, 405u);
  EXPECT_EQ(desk.answer(get("/ws")).status, 400u) << "no upgrade";
  HttpQuestion foreign = get("/api/track");
  foreign.origin = "http://evil.com";
  EXPECT_EQ(desk.answer(foreign).status, 403u);
  EXPECT_EQ(desk.answer(get("/api/track?token=0000000000000000")).status, 401u);
  EXPECT_EQ(desk.answer(get("/nothing")).body->back(), '\n');
}

TEST(HttpResponder, ADocumentThatIsMadeIsMadeForEachWhoAsks) {
  HttpConfig with = config();
  int asked = 0;
  with.made["/metrics"] = [&asked] { return Shown{std::to_string(++asked), "text/x"}; };
  HttpResponder desk(std::move(with));
  EXPECT_EQ(*desk.answer(get("/metrics")).body, "1");
  const HttpAnswer again = desk.answer(get("/metrics"));
  EXPECT_EQ(*again.body, "2");
  EXPECT_EQ(again.type, "text/x");
  EXPECT_EQ(again.cache, "no-store");
  EXPECT_EQ(desk.answer(put("/metrics", "x")).status, 405u);
}

TEST(HttpResponder, APortOfAnotherProtocolIsThatOnly) {
  HttpConfig foreign = config();
  foreign.subprotocols = {"a.v1", "b.v1"};
  HttpResponder desk(std::move(foreign));
  const auto open = [&desk](std::string_view target, std::string_view offered, bool upgrade) {
    HttpQuestion question = get(target);
    question.subprotocols = offered;
    question.upgrade = upgrade;
    return desk.answer(question);
  };
  EXPECT_EQ(open("/", "b.v1", true).subprotocol, "b.v1");
  EXPECT_EQ(open("/?token=" + std::string{kViewer}, "x,\tb.v1 , a.v1", true).subprotocol, "b.v1");
  EXPECT_TRUE(open("/", "a.v1", true).visitor);
  for (const char* offered : {"", "c.v1", "a.v1x", ",", " , "}) {
    EXPECT_EQ(open("/", offered, true).status, 400u) << offered;
    EXPECT_FALSE(open("/", offered, true).visitor);
  }
  EXPECT_EQ(open("/", "a.v1", false).status, 400u) << "no upgrade";
  EXPECT_EQ(open("/ws", "a.v1", true).status, 404u);
  EXPECT_EQ(open("/api/track", "", false).status, 404u);
}

// Without a token there is the page, which shows nothing by itself, and nothing else.
TEST(HttpResponder, WhereTokensBindOnlyThePageComesWithoutOne) {
  HttpConfig bound = config();
  bound.access.default_role.reset();
  bound.made["/metrics"] = [] { return Shown{"1", "text/x"}; };
  HttpResponder desk(std::move(bound));
  EXPECT_EQ(desk.answer(get("/")).status, 200u);
  EXPECT_EQ(desk.answer(get("/nothing")).status, 404u);
  for (const char* const path : {"/api/track", "/api/layouts/none", "/metrics", "/ws"})
    EXPECT_EQ(desk.answer(get(path)).status, 401u) << path;
  HttpQuestion socket = get("/ws");
  socket.upgrade = true;
  EXPECT_FALSE(desk.answer(socket).visitor);
  HttpQuestion page = get("/");
  page.upgrade = true;
  EXPECT_EQ(desk.answer(page).status, 401u);
  const std::string with = std::string{"/api/track?token="} + kViewer;
  EXPECT_EQ(desk.answer(get(with)).status, 200u);
  HttpQuestion foreign = get("/");
  foreign.origin = "http://evil.com";
  EXPECT_EQ(desk.answer(foreign).status, 403u) << "nor does a page of somebody else have it";
}

TEST(HttpResponder, ATokenOfAnotherProtocolsPortIsItsPath) {
  HttpConfig bound = config();
  bound.access.default_role.reset();
  bound.subprotocols = {"foxglove.sdk.v1"};
  HttpResponder desk(std::move(bound));
  const auto opens = [&](const std::string& path) {
    HttpQuestion question = get(path);
    question.upgrade = true;
    question.subprotocols = "foxglove.sdk.v1";
    return desk.answer(question);
  };
  EXPECT_TRUE(opens(std::string{"/"} + kViewer).visitor);
  for (const std::string& path :
       {std::string{"/"}, std::string{"/0000000000000000"}, std::string{"/?token="} + kViewer}) {
    EXPECT_EQ(opens(path).status, 401u) << path;
  }
}

TEST(HttpResponder, TheSocketIsGivenToWhoMayHaveIt) {
  HttpResponder desk(config());
  HttpQuestion question = get("/ws");
  question.upgrade = true;
  EXPECT_EQ(desk.answer(question).visitor->role, Role::kViewer);
  const std::string target = std::string{"/ws?x=1&token="} + kOperator;
  question.target = target;
  EXPECT_EQ(desk.answer(question).visitor->name, "Anna");
}

TEST(HttpResponder, EachCarHasItsOwnDocumentsAndNoneIsGivenAnothers) {
  HttpConfig both = config();
  both.cars = {{.number = 7, .documents = {{"/api/track", "[7]"}}},
               {.number = 0, .documents = {{"/api/track", "[0]"}, {"/api/x", ""}}}};
  HttpResponder desk(std::move(both));
  EXPECT_EQ(*desk.answer(get("/api/track")).body, "[7]") << "the first";
  EXPECT_EQ(*desk.answer(get("/api/track?car=7")).body, "[7]");
  EXPECT_EQ(*desk.answer(get("/api/track?x=1&car=0")).body, "[0]");
  EXPECT_EQ(desk.answer(get("/api/x?car=0")).status, 204u);
  EXPECT_EQ(desk.answer(get("/api/x?car=7")).status, 404u);
  for (const char* const nobody : {"8", "", "7x", "-7", "+7", "07777777777777", "%37"}) {
    const std::string target = std::string{"/api/track?car="} + nobody;
    EXPECT_EQ(desk.answer(get(target)).status, 404u) << nobody;
    const std::string socket = std::string{"/ws?car="} + nobody;
    HttpQuestion question = get(socket);
    question.upgrade = true;
    const HttpAnswer answer = desk.answer(question);
    EXPECT_EQ(answer.status, 404u) << nobody;
    EXPECT_FALSE(answer.visitor) << nobody;
  }
  HttpQuestion question = get("/ws?car=0");
  question.upgrade = true;
  EXPECT_EQ(desk.answer(question).car, 1u);
}

TEST(HttpResponder, WhatIsShownReplacesWhatWasBefore) {
  HttpResponder desk(config());
  desk.show("/api/cars", {"[1]", kJsonType});
  desk.show("/api/cars", {"[2]", kJsonType});
  const HttpAnswer answer = desk.answer(get("/api/cars"));
  EXPECT_EQ(*answer.body, "[2]");
  EXPECT_EQ(answer.type, "application/json");
}

TEST(HttpResponder, LayoutsAreKeptByOperators) {
  const auto folder = transport::TemporaryFolder::create("layouts");
  ASSERT_TRUE(folder);
  HttpResponder desk(config(folder->path()));
  const std::string as = std::string{"?token="};
  EXPECT_EQ(desk.answer(put("/api/layouts/mine", "{}")).status, 403u);
  EXPECT_EQ(desk.answer(put("/api/layouts/mine" + as + kViewer, "{}")).status, 403u);
  HttpQuestion question = put("/api/layouts/mine", R"({"a": 1})");
  const std::string bearer = std::string{"Bearer "} + kOperator;
  question.authorization = bearer;
  EXPECT_EQ(desk.answer(question).status, 200u);
  EXPECT_EQ(*desk.answer(get("/api/layouts/mine")).body, R"({"a": 1})");
  HttpResponder later(config(folder->path()));
  EXPECT_EQ(*later.answer(get("/api/layouts/mine")).body, R"({"a": 1})") << "after a restart";
}

TEST(HttpResponder, WhatIsNoLayoutIsNotKept) {
  HttpResponder desk(config());
  const std::string bearer = std::string{"Bearer "} + kOperator;
  const auto status = [&](const std::string& name, const std::string& body) {
    const std::string target = "/api/layouts/" + name;
    HttpQuestion question = put(target, body);
    question.authorization = bearer;
    return desk.answer(question).status;
  };
  EXPECT_EQ(status("a", "{"), 400u);
  EXPECT_EQ(status("a", "[]"), 400u);
  EXPECT_EQ(status("a", std::string(100, '[')), 400u);
  EXPECT_EQ(status("a", "{\"x\": \"" + std::string(HttpResponder::kLayoutBytes, 'x') + "\"}"),
            413u);
  EXPECT_EQ(status(std::string(41, 'a'), "{}"), 404u);
  for (std::size_t i = 0; i < HttpResponder::kLayoutsMax; ++i) {
    EXPECT_EQ(status("n" + std::to_string(i), "{}"), 200u);
  }
  EXPECT_EQ(status("one_more", "{}"), 507u);
}

TEST(HttpResponder, AHostThatIsNoneDoesNotGetIntoThePolicy) {
  HttpResponder desk(config());
  HttpQuestion question = get("/");
  question.host = "localhost; script-src *";
  EXPECT_EQ(desk.answer(question).policy.find("script-src"), std::string::npos);
}

TEST(HttpResponder, QueryValues) {
  EXPECT_EQ(query_value("/ws?token=a&b=c", "token"), "a");
  EXPECT_EQ(query_value("/ws?xtoken=a&token=d", "token"), "d");
  EXPECT_EQ(query_value("/ws?token", "token"), "");
  EXPECT_EQ(query_value("/ws", "token"), "");
}

}  // namespace
}  // namespace pitwall::publishers::web

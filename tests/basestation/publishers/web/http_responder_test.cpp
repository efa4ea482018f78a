// SPDX-License-Identifier: Apache-2.0
#include "basestation/publishers/web/http_responder.hpp"

#include <gtest/gtest.h>

#include "basestation/publishers/web/admission/session_cookie.hpp"
#include "protocol/transport/file.hpp"

namespace pitwall::publishers::web {
namespace {

constexpr const char *kOperator = "8f2c41d09b7a4d51", *kViewer = "77aa0c1be04f43f2";

HttpConfig config(std::string layouts = {}) {
  const std::string file =
      std::string{"operator "} + kOperator + " Anna\nviewer " + kViewer + " G\n";
  return {.access = {.tokens = std::make_shared<TokenStore>(*Tokens::parse(file, "tokens"))},
          .console = "/nowhere",
          .documents = {{"/api/track", "{}"}},
          .layouts = std::move(layouts)};
}

HttpQuestion get(std::string_view target) {
  return {.method = "GET", .target = target, .host = "localhost:8080"};
}
constexpr const char *kAsOperator = "Bearer 8f2c41d09b7a4d51",
                     *kAsViewer = "Bearer 77aa0c1be04f43f2";
HttpQuestion put(std::string_view target, std::string_view body) {
  return {.method = "PUT", .target = target, .host = "localhost:8080", .body = body};
}

TEST(HttpResponder, AConsoleThatIsNotBuiltIsSaid) {
  HttpResponder responder(config());
  const HttpAnswer answer = responder.answer(get("/"));
  EXPECT_EQ(answer.status, 200u);
  EXPECT_NE(answer.body->find("--console-dir"), std::string::npos);
  EXPECT_NE(answer.policy.find("default-src 'self'"), std::string::npos);
  EXPECT_EQ(answer.policy.find("unsafe"), std::string::npos);
}

TEST(HttpResponder, WhatIsNotThereOrNotAllowedIsRefusedWithALine) {
  HttpResponder responder(config());
  EXPECT_EQ(responder.answer(get("/nothing")).status, 404u);
  EXPECT_EQ(responder.answer(get("/api/layouts/none")).status, 204u);
  EXPECT_EQ(responder.answer(get("/api/layouts/../keys")).status, 404u);
  EXPECT_EQ(responder.answer(put("/api/track", "{}")).status, 405u);
  EXPECT_EQ(responder.answer(get("/ws")).status, 400u) << "no upgrade";
  HttpQuestion foreign = get("/api/track");
  foreign.origin = "http://evil.com";
  EXPECT_EQ(responder.answer(foreign).status, 403u);
  HttpQuestion wrong = get("/api/track");
  wrong.authorization = "Bearer 0000000000000000";
  EXPECT_EQ(responder.answer(wrong).status, 401u);
  EXPECT_EQ(responder.answer(get("/nothing")).body->back(), '\n');
}

TEST(HttpResponder, ADocumentThatIsMadeIsMadeForEachWhoAsks) {
  HttpConfig with = config();
  int asked = 0;
  with.made["/metrics"] = [&asked] { return Shown{std::to_string(++asked), "text/x"}; };
  HttpResponder responder(std::move(with));
  EXPECT_EQ(*responder.answer(get("/metrics")).body, "1");
  const HttpAnswer again = responder.answer(get("/metrics"));
  EXPECT_EQ(*again.body, "2");
  EXPECT_EQ(again.type, "text/x");
  EXPECT_EQ(again.cache, "no-store");
  EXPECT_EQ(responder.answer(put("/metrics", "x")).status, 405u);
}

TEST(HttpResponder, APortOfAnotherProtocolIsThatOnly) {
  HttpConfig foreign = config();
  foreign.subprotocols = {"a.v1", "b.v1"};
  HttpResponder responder(std::move(foreign));
  const auto open = [&responder](std::string_view target, std::string_view offered, bool upgrade) {
    HttpQuestion question = get(target);
    question.subprotocols = offered;
    question.upgrade = upgrade;
    return responder.answer(question);
  };
  EXPECT_EQ(open("/", "b.v1", true).subprotocol, "b.v1");
  EXPECT_EQ(open("/?x=1", "x,\tb.v1 , a.v1", true).subprotocol, "b.v1");
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
  HttpResponder responder(std::move(bound));
  EXPECT_EQ(responder.answer(get("/")).status, 200u);
  EXPECT_EQ(responder.answer(get("/nothing")).status, 404u);
  for (const char* const path : {"/api/track", "/api/layouts/none", "/metrics", "/ws"})
    EXPECT_EQ(responder.answer(get(path)).status, 401u) << path;
  HttpQuestion socket = get("/ws");
  socket.upgrade = true;
  EXPECT_FALSE(responder.answer(socket).visitor);
  HttpQuestion page = get("/");
  page.upgrade = true;
  EXPECT_EQ(responder.answer(page).status, 401u);
  HttpQuestion with = get("/api/track");
  with.authorization = kAsViewer;
  EXPECT_EQ(responder.answer(with).status, 200u);
  HttpQuestion foreign = get("/");
  foreign.origin = "http://evil.com";
  EXPECT_EQ(responder.answer(foreign).status, 403u) << "nor does a page of somebody else have it";
}

TEST(HttpResponder, ATokenOfAnotherProtocolsPortIsItsPath) {
  HttpConfig bound = config();
  bound.access.default_role.reset();
  bound.subprotocols = {"foxglove.sdk.v1"};
  HttpResponder responder(std::move(bound));
  const auto opens = [&](const std::string& path) {
    HttpQuestion question = get(path);
    question.upgrade = true;
    question.subprotocols = "foxglove.sdk.v1";
    return responder.answer(question);
  };
  EXPECT_TRUE(opens(std::string{"/"} + kViewer).visitor);
  for (const std::string& path :
       {std::string{"/"}, std::string{"/0000000000000000"}, std::string{"/?token="} + kViewer}) {
    EXPECT_EQ(opens(path).status, 401u) << path;
  }
}

TEST(HttpResponder, TheSocketIsGivenToWhoMayHaveIt) {
  HttpResponder responder(config());
  HttpQuestion question = get("/ws");
  question.upgrade = true;
  EXPECT_EQ(responder.answer(question).visitor->role, Role::kViewer);
  question.authorization = kAsOperator;
  EXPECT_EQ(responder.answer(question).visitor->name, "Anna");
}

TEST(HttpResponder, EachCarHasItsOwnDocumentsAndNoneIsGivenAnothers) {
  HttpConfig both = config();
  both.cars = {{.number = 7, .documents = {{"/api/track", "[7]"}}},
               {.number = 0, .documents = {{"/api/track", "[0]"}, {"/api/x", ""}}}};
  HttpResponder responder(std::move(both));
  EXPECT_EQ(*responder.answer(get("/api/track")).body, "[7]") << "the first";
  EXPECT_EQ(*responder.answer(get("/api/track?car=7")).body, "[7]");
  EXPECT_EQ(*responder.answer(get("/api/track?x=1&car=0")).body, "[0]");
  EXPECT_EQ(responder.answer(get("/api/x?car=0")).status, 204u);
  EXPECT_EQ(responder.answer(get("/api/x?car=7")).status, 404u);
  for (const char* const nobody : {"8", "", "7x", "-7", "+7", "07777777777777", "%37"}) {
    const std::string target = std::string{"/api/track?car="} + nobody;
    EXPECT_EQ(responder.answer(get(target)).status, 404u) << nobody;
    const std::string socket = std::string{"/ws?car="} + nobody;
    HttpQuestion question = get(socket);
    question.upgrade = true;
    const HttpAnswer answer = responder.answer(question);
    EXPECT_EQ(answer.status, 404u) << nobody;
    EXPECT_FALSE(answer.visitor) << nobody;
  }
  HttpQuestion question = get("/ws?car=0");
  question.upgrade = true;
  EXPECT_EQ(responder.answer(question).car, 1u);
}

TEST(HttpResponder, WhatIsShownReplacesWhatWasBefore) {
  HttpResponder responder(config());
  responder.show("/api/cars", {"[1]", kJsonType});
  responder.show("/api/cars", {"[2]", kJsonType});
  const HttpAnswer answer = responder.answer(get("/api/cars"));
  EXPECT_EQ(*answer.body, "[2]");
  EXPECT_EQ(answer.type, "application/json");
}

TEST(HttpResponder, LayoutsAreKeptByOperators) {
  const auto folder = transport::TemporaryFolder::create("layouts");
  ASSERT_TRUE(folder);
  HttpResponder responder(config(folder->path()));
  EXPECT_EQ(responder.answer(put("/api/layouts/mine", "{}")).status, 403u);
  HttpQuestion question = put("/api/layouts/mine", R"({"a": 1})");
  question.authorization = kAsViewer;
  EXPECT_EQ(responder.answer(question).status, 403u);
  question.authorization = kAsOperator;
  EXPECT_EQ(responder.answer(question).status, 200u);
  EXPECT_EQ(*responder.answer(get("/api/layouts/mine")).body, R"({"a": 1})");
  HttpResponder later(config(folder->path()));
  EXPECT_EQ(*later.answer(get("/api/layouts/mine")).body, R"({"a": 1})") << "after a restart";
}

TEST(HttpResponder, WhatIsNoLayoutIsNotKept) {
  HttpResponder responder(config());
  const auto status = [&](const std::string& name, const std::string& body) {
    const std::string target = "/api/layouts/" + name;
    HttpQuestion question = put(target, body);
    question.authorization = kAsOperator;
    return responder.answer(question).status;
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
  HttpResponder responder(config());
  HttpQuestion question = get("/");
  question.host = "localhost; script-src *";
  EXPECT_EQ(responder.answer(question).policy.find("script-src"), std::string::npos);
}

HttpQuestion log_in(std::string_view body) {
  return {.method = "POST", .target = "/api/session", .host = "localhost:8080", .body = body};
}

// The cookie as a browser sends it back.
std::string cookie_of(const HttpAnswer& answer) {
  return answer.set_cookies.at(0).substr(0, answer.set_cookies.at(0).find(';'));
}

TEST(HttpResponder, ALoginGivesACookieThatIsWhoLoggedIn) {
  HttpConfig bound = config();
  bound.access.default_role.reset();
  UtcTime now{1'700'000'000'000'000'000};
  bound.utc = [&now] { return now; };
  HttpResponder responder(std::move(bound));
  responder.serve_at(8080);
  EXPECT_EQ(responder.answer(get("/api/session")).status, 401u);
  const HttpAnswer in = responder.answer(log_in(R"({"token": "8f2c41d09b7a4d51"})"));
  EXPECT_EQ(in.status, 204u);
  for (const std::string& set : in.set_cookies)
    EXPECT_EQ(set.find(kOperator), std::string::npos) << "it does not tell the token";
  const std::string cookie = cookie_of(in);
  HttpQuestion question = get("/api/session");
  question.cookie = cookie;
  EXPECT_EQ(*responder.answer(question).body,
            R"({"role": "operator", "name": "Anna", "logged_in": true})");
  question.target = "/api/track";
  EXPECT_EQ(responder.answer(question).status, 200u);
  now.ns += kSessionLasts.ns;
  EXPECT_EQ(responder.answer(question).status, 401u) << "it ends";
}

TEST(HttpResponder, ALoginThatIsNoneGivesNone) {
  HttpResponder responder(config());
  for (const char* body : {"", "{}", "[]", "{\"token\": 5}", "x", "{\"token\": \"\"}"}) {
    const HttpAnswer answer = responder.answer(log_in(body));
    EXPECT_EQ(answer.status, 400u) << body;
    EXPECT_TRUE(answer.set_cookies.empty()) << body;
  }
  const HttpAnswer wrong = responder.answer(log_in(R"({"token": "0000000000000000"})"));
  EXPECT_EQ(wrong.status, 401u);
  EXPECT_TRUE(wrong.set_cookies.empty());
  HttpQuestion foreign = log_in(R"({"token": "8f2c41d09b7a4d51"})");
  foreign.origin = "http://evil.com";
  EXPECT_EQ(responder.answer(foreign).status, 403u);
  HttpQuestion put_one = log_in("{}");
  put_one.method = "PUT";
  EXPECT_EQ(responder.answer(put_one).allow, "GET, POST, DELETE");
}

TEST(HttpResponder, ALogoutTakesTheCookiesAway) {
  HttpResponder responder(config());
  HttpQuestion question = log_in("");
  question.method = "DELETE";
  const auto cookies = responder.answer(question).set_cookies;
  EXPECT_EQ(cookies.size(), 2U);
  for (const std::string& set : cookies) EXPECT_NE(set.find("Max-Age=0"), std::string::npos);
}

TEST(HttpResponder, ACookieGoesOverTlsOnlyWhereThereIsTls) {
  constexpr const char* kBody = R"({"token": "8f2c41d09b7a4d51"})";
  HttpResponder plain(config());
  for (const std::string& set : plain.answer(log_in(kBody)).set_cookies)
    EXPECT_EQ(set.find("Secure"), std::string::npos);
  HttpQuestion through_a_proxy = log_in(kBody);
  through_a_proxy.forwarded_proto = "https";
  for (const std::string& set : plain.answer(through_a_proxy).set_cookies)
    EXPECT_TRUE(set.ends_with("; Secure"));
  HttpConfig encrypted = config();
  encrypted.access.encrypted = true;
  const HttpAnswer in = HttpResponder(std::move(encrypted)).answer(log_in(kBody));
  for (const std::string& set : in.set_cookies) EXPECT_TRUE(set.ends_with("; Secure"));
}

HttpConfig two_cars() {
  HttpConfig two = config();
  two.cars.push_back({.number = 7});
  two.cars.push_back({.number = 9});
  return two;
}

TEST(HttpResponder, APageOfABenchIsToBeAskedForAtItsCar) {
  HttpResponder responder(two_cars());
  const HttpAnswer answer = responder.answer(get("/bench/9/sweeps/grip/report.html?x=1"));
  EXPECT_EQ(answer.page, "sweeps/grip/report.html");
  EXPECT_EQ(answer.car, 1U);
  for (const char* none : {"/bench/", "/bench/7", "/bench/7/", "/bench/8/runs/1/report.html",
                           "/bench/x/runs/1/report.html", "/bench//runs/1/report.html", "/bench"}) {
    const HttpAnswer refused = responder.answer(get(none));
    EXPECT_EQ(refused.status, 404u) << none;
    EXPECT_EQ(refused.page, "") << none;
  }
  EXPECT_EQ(responder.answer(put("/bench/7/runs/1/report.html", "x")).allow, "GET, HEAD");
}

TEST(HttpResponder, APageOfABenchIsForeignToTheBase) {
  const HttpAnswer page = page_of_bench("<p>");
  EXPECT_EQ(page.status, 200u);
  EXPECT_EQ(*page.body, "<p>");
  EXPECT_EQ(page.type, "text/html; charset=utf-8");
  EXPECT_TRUE(page.policy.starts_with("sandbox allow-scripts; default-src 'none';"));
  EXPECT_EQ(page.policy.find("allow-same-origin"), std::string::npos);
  EXPECT_EQ(page.policy.find("connect-src"), std::string::npos) << "as by default: nothing";
}

// A link in a page without an origin is one from elsewhere to the browser.
TEST(HttpResponder, TheCookieForPagesOpensPagesAndNothingElse) {
  HttpConfig bound = two_cars();
  bound.access.default_role.reset();
  HttpResponder responder(std::move(bound));
  responder.serve_at(8080);
  HttpQuestion question = get("/bench/7/runs/1/report.html");
  EXPECT_EQ(responder.answer(question).status, 401u);
  const HttpAnswer in = responder.answer(log_in(R"({"token": "77aa0c1be04f43f2"})"));
  ASSERT_EQ(in.set_cookies.size(), 2U);
  EXPECT_NE(in.set_cookies[1].find("; Path=/bench/; "), std::string::npos);
  const std::string of_pages = in.set_cookies[1].substr(0, in.set_cookies[1].find(';'));
  question.cookie = of_pages;
  EXPECT_EQ(responder.answer(question).page, "runs/1/report.html") << "a viewer may read it";
  for (const char* path : {"/api/track", "/ws", "/api/session", "/api/layouts/a", "/bench"}) {
    question.target = path;
    question.upgrade = std::string_view{path} == "/ws";
    EXPECT_EQ(responder.answer(question).status, std::string_view{path} == "/bench" ? 404u : 401u)
        << path;
  }
}

TEST(HttpResponder, ATokenInAnAddressIsRefused) {
  HttpResponder responder(config());
  for (const char* path : {"/?token=8f2c41d09b7a4d51", "/api/track?car=0&token=8f2c41d09b7a4d51",
                           "/ws?token=8f2c41d09b7a4d51"}) {
    HttpQuestion question = get(path);
    question.upgrade = std::string_view{path}.starts_with("/ws");
    EXPECT_EQ(responder.answer(question).status, 400u) << path;
    EXPECT_FALSE(responder.answer(question).visitor);
  }
}

TEST(HttpResponder, QueryValues) {
  EXPECT_EQ(query_value("/ws?token=a&b=c", "token"), "a");
  EXPECT_EQ(query_value("/ws?xtoken=a&token=d", "token"), "d");
  EXPECT_EQ(query_value("/ws?token", "token"), "");
  EXPECT_EQ(query_value("/ws", "token"), "");
}

}  // namespace
}  // namespace pitwall::publishers::web

// SPDX-License-Identifier: Apache-2.0
#include "basestation/publishers/web/admission/session_cookie.hpp"

#include <gtest/gtest.h>

namespace pitwall::publishers::web {
namespace {

TEST(SessionCookie, NoScriptReadsItAndNoOtherPageSendsIt) {
  EXPECT_EQ(set_cookie(8080, false, "a.1.b"),
            "pitwall-8080=a.1.b; Path=/; Max-Age=86400; HttpOnly; SameSite=Strict");
  EXPECT_EQ(set_cookie(8443, true, "a.1.b"),
            "__Host-pitwall-8443=a.1.b; Path=/; Max-Age=86400; HttpOnly; SameSite=Strict; Secure");
  EXPECT_EQ(set_cookie(8080, false, ""),
            "pitwall-8080=; Path=/; Max-Age=0; HttpOnly; SameSite=Strict");
}

TEST(SessionCookie, TheOneForPagesGoesNowhereElse) {
  EXPECT_EQ(set_page_cookie(8080, false, "/bench/", "a.1.b"),
            "pitwall-pages-8080=a.1.b; Path=/bench/; Max-Age=86400; HttpOnly; SameSite=Lax");
  EXPECT_EQ(
      set_page_cookie(8443, true, "/bench/", ""),
      "__Secure-pitwall-pages-8443=; Path=/bench/; Max-Age=0; HttpOnly; SameSite=Lax; Secure");
  constexpr const char* kAll = "pitwall-pages-80=one; __Secure-pitwall-pages-81=two; pitwall-80=x";
  EXPECT_EQ(page_session_of(kAll, 80), "one");
  EXPECT_EQ(page_session_of(kAll, 81), "two");
  EXPECT_EQ(page_session_of(kAll, 8), "");
  EXPECT_EQ(session_of("pitwall-pages-80=one", 80), "") << "not the session of a console";
}

// Two bases on one machine get each other's cookies.
TEST(SessionCookie, EachPortHasItsOwn) {
  constexpr const char* kBoth = "x=1; pitwall-8080=one;pitwall-80=two; __Host-pitwall-81=three";
  EXPECT_EQ(session_of(kBoth, 8080), "one");
  EXPECT_EQ(session_of(kBoth, 80), "two");
  EXPECT_EQ(session_of(kBoth, 81), "three");
  EXPECT_EQ(session_of(kBoth, 8), "");
  for (const char* nothing : {"", ";", ";;", "=", "pitwall-8080", "pitwall-8080 =one"})
    EXPECT_EQ(session_of(nothing, 8080), "") << nothing;
}

}  // namespace
}  // namespace pitwall::publishers::web

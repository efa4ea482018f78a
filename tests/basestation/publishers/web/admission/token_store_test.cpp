// SPDX-License-Identifier: Apache-2.0
#include "basestation/publishers/web/admission/token_store.hpp"

#include <gtest/gtest.h>

#include <string>

#include "protocol/transport/file.hpp"

namespace pitwall::publishers::web {
namespace {

constexpr const char *kTokenOfAnna = "8f2c41d09b7a4d51", *kTokenOfGarage = "77aa0c1be04f43f2";

class TokenBookTest : public testing::Test {
 protected:
  void write(const std::string& text) { ASSERT_TRUE(transport::write_file(file_, text, 0600)); }
  transport::TemporaryFolder folder_ = *transport::TemporaryFolder::create("tokens");
  std::string file_ = folder_.path() + "/tokens";
};

TEST_F(TokenBookTest, ALineThatIsTakenAwayHoldsNoLonger) {
  write(std::string{"operator "} + kTokenOfAnna + " Anna\nviewer " + kTokenOfGarage + " Garage\n");
  const auto tokens = TokenStore::open(file_);
  ASSERT_TRUE(tokens);
  const auto anna = (*tokens)->find(kTokenOfAnna);
  ASSERT_TRUE(anna);
  EXPECT_FALSE(*(*tokens)->refresh()) << "nothing has changed";
  write(std::string{"viewer "} + kTokenOfGarage + " Garage\n");
  EXPECT_TRUE(*(*tokens)->refresh());
  EXPECT_FALSE((*tokens)->find(kTokenOfAnna));
  EXPECT_FALSE((*tokens)->may_stay(*anna));
  EXPECT_TRUE((*tokens)->may_stay(*(*tokens)->find(kTokenOfGarage)));
  EXPECT_TRUE((*tokens)->may_stay(Identity{})) << "who came without one";
}

TEST_F(TokenBookTest, AFileWithAMistakeChangesNothingAndIsToldOnce) {
  write(std::string{"operator "} + kTokenOfAnna + " Anna\n");
  const auto tokens = TokenStore::open(file_);
  ASSERT_TRUE(tokens);
  write("operator short Anna and more than before\n");
  const auto again = (*tokens)->refresh();
  ASSERT_FALSE(again);
  EXPECT_EQ(again.error().place, file_ + ":1");
  EXPECT_FALSE(*(*tokens)->refresh());
  EXPECT_TRUE((*tokens)->find(kTokenOfAnna));
}

TEST_F(TokenBookTest, AFileThatOthersReadIsRefused) {
  ASSERT_TRUE(transport::write_file(file_, "", 0644));
  EXPECT_FALSE(TokenStore::open(file_));
}

}  // namespace
}  // namespace pitwall::publishers::web

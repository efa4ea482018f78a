// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/live/operator_line.hpp"

#include <gtest/gtest.h>

#include "protocol/transport/file.hpp"

namespace pitwall::bench {
namespace {

TEST(OperatorLine, ABaseThatBeginsAnewIsSpokenToAgain) {
  const auto folder = transport::TemporaryFolder::create("operator_line");
  const std::string path = folder->path() + "/commands";
  OperatorLine line{path};
  line.send("to nobody");
  for (int run = 0; run < 2; ++run) {
    auto base = transport::LineListener::open(path);
    ASSERT_TRUE(base);
    line.send("take 1");
    auto connection = base->accept();
    ASSERT_TRUE(connection);
    line.send("stop controlled");
    std::vector<std::string> received;
    while (received.size() < 2)
      for (std::string& one : connection->receive()) received.push_back(std::move(one));
    EXPECT_EQ(received, (std::vector<std::string>{"take 1", "stop controlled"}));
  }
}

}  // namespace
}  // namespace pitwall::bench

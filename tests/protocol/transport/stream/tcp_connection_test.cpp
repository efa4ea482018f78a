// What a connection says is heard in stream_link_test.cpp.
// SPDX-License-Identifier: Apache-2.0
#include "protocol/transport/stream/tcp_connection.hpp"

#include <gtest/gtest.h>

#include "protocol/transport/clock.hpp"

namespace pitwall::transport {
namespace {

TEST(TcpConnection, WhereNobodyListensItIsRefusedAndNobodyWaited) {
  const auto begun = begin_connect({.port = 1});
  if (!begun) return;  // the kernel knew at once
  const Instant limit = monotonic_now() + seconds(10);
  std::optional<PosixOutcome> outcome;
  while (!outcome && monotonic_now() < limit) outcome = connect_outcome(begun->get());
  ASSERT_TRUE(outcome);
  EXPECT_EQ(outcome->error, ECONNREFUSED);
}

}  // namespace
}  // namespace pitwall::transport

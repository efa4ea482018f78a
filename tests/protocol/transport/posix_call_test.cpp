// SPDX-License-Identifier: Apache-2.0
#include "protocol/transport/posix_call.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>

namespace pitwall::transport {
namespace {

TEST(PosixCall, RetriesUntilTheCallIsNoLongerInterrupted) {
  int calls = 0;
  const auto outcome = posix_call([&] {
    errno = EINTR;
    return ++calls < 4 ? -1 : 42;
  });
  EXPECT_TRUE(outcome.ok());
  EXPECT_EQ(outcome.value, 42);
  EXPECT_EQ(calls, 4);
}

TEST(PosixCall, EachConventionKnowsItsOwnFailure) {
  const auto by_errno = posix_call([] {
    errno = ENOENT;
    return -1;
  });
  EXPECT_EQ(by_errno.error, ENOENT);
  const auto by_value = posix_call([] { return EINVAL; }, Success::kZeroElseNumber);
  EXPECT_EQ(by_value.error, EINVAL);
  EXPECT_TRUE(posix_call([] { return EINVAL; }).ok());  // a plain positive result
  EXPECT_TRUE(posix_call([] { return 0; }, Success::kZeroElseNumber).ok());
  EXPECT_FALSE(posix_call([] { return -1; }).ok());  // failure without a reason is still one
}

TEST(FileDescriptor, ClosesExactlyOnceWhateverMoves) {
  const int raw = ::open("/dev/null", O_RDONLY | O_CLOEXEC);
  ASSERT_GE(raw, 0);
  {
    FileDescriptor first(raw);
    FileDescriptor second(std::move(first));
    FileDescriptor third;
    third = std::move(second);
    EXPECT_EQ(third.get(), raw);
    EXPECT_GE(fcntl(raw, F_GETFD), 0);
  }
  EXPECT_EQ(fcntl(raw, F_GETFD), -1);
  EXPECT_EQ(errno, EBADF);
}

}  // namespace
}  // namespace pitwall::transport

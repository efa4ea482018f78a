// The library's ptrace() beside the C library's, on a process that is traced; no guest. What the
// machine's own kernel has of state is the oracle.
// SPDX-License-Identifier: Apache-2.0
#include <dlfcn.h>
#include <gtest/gtest.h>
#include <linux/elf.h>
#include <signal.h>
#include <sys/ptrace.h>
#include <sys/uio.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <cstring>
#include <vector>

#include "hil/can_bus/register_state/ptrace_library.hpp"
#include "protocol/transport/file.hpp"

namespace pitwall::can_bus {
namespace {

using Bytes = std::vector<std::uint8_t>;
using Ptrace = long (*)(__ptrace_request, pid_t, void*, void*);

constexpr std::size_t kSse = 160, kHeader = 512, kAvx = 576;  // where they begin
constexpr std::size_t kAvxEnd = 832;                          // a buffer for AVX and no more
constexpr std::size_t kGuest = 2'696;                         // User-mode Linux 6.1

void* const kExtendedState = reinterpret_cast<void*>(NT_X86_XSTATE);

class TracedProcess : public testing::Test {
 protected:
  void SetUp() override {
    const std::string path = folder_.path() + "/ptrace.so";
    ASSERT_TRUE(transport::write_file(path, ptrace_library(), 0700));
    library_ = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
    ASSERT_NE(library_, nullptr) << dlerror();
    ours_ = reinterpret_cast<Ptrace>(dlsym(library_, "ptrace"));
    ASSERT_NE(ours_, nullptr) << dlerror();
    process_ = fork();
    if (process_ == 0) {
      ptrace(PTRACE_TRACEME, 0, nullptr, nullptr);
      raise(SIGSTOP);
      _exit(0);
    }
    int status = 0;
    ASSERT_EQ(waitpid(process_, &status, 0), process_);
    ASSERT_TRUE(WIFSTOPPED(status));
  }
  void TearDown() override {
    if (process_ > 0) {
      kill(process_, SIGKILL);
      waitpid(process_, nullptr, 0);
    }
    if (library_ != nullptr) dlclose(library_);
  }

  // All that the kernel has, by the C library.
  Bytes state() const {
    Bytes bytes(64 * 1024);
    iovec whole{bytes.data(), bytes.size()};
    EXPECT_EQ(ptrace(PTRACE_GETREGSET, process_, kExtendedState, &whole), 0);
    bytes.resize(whole.iov_len);
    return bytes;
  }
  long set_by_ours(Bytes state) const {
    iovec part{state.data(), state.size()};
    return ours_(PTRACE_SETREGSET, process_, kExtendedState, &part);
  }
  // The first bytes of a state that differs from any other in every SSE and AVX register.
  Bytes cut_state(std::size_t size, unsigned seed) const {
    Bytes bytes = state();
    const auto fill = [&](std::size_t from, std::size_t to) {
      for (std::size_t i = from; i < std::min(to, bytes.size()); ++i)
        bytes[i] = static_cast<std::uint8_t>(1 + (i * 31 + seed) % 251);
    };
    fill(kSse, kSse + 16 * 16);
    fill(kAvx, kAvxEnd);
    const unsigned used = bytes.size() >= kAvxEnd ? 7 : 3;  // x87, SSE, AVX
    bytes[kHeader] = static_cast<std::uint8_t>(bytes[kHeader] | used);
    bytes.resize(std::min(size, bytes.size()));
    return bytes;
  }

  transport::TemporaryFolder folder_ = *transport::TemporaryFolder::create("pitwall-ptrace-");
  void* library_ = nullptr;
  Ptrace ours_ = nullptr;
  pid_t process_ = -1;
};

TEST_F(TracedProcess, WhatIsSetIsThereAndZerosAreBehind) {
  const std::size_t whole = state().size();
  unsigned seed = 0;
  // The longer first, and again: nothing of one call is left for the next.
  for (const std::size_t size : {whole, whole - 8, kGuest, kAvxEnd, kGuest, kAvxEnd, whole}) {
    if (size > whole) continue;  // this machine has no more than AVX
    const Bytes given = cut_state(size, ++seed);
    ASSERT_EQ(set_by_ours(given), 0) << size << " of " << whole << ": " << std::strerror(errno);
    Bytes expected = given;
    expected.resize(whole, 0);
    EXPECT_EQ(state(), expected) << size << " of " << whole;
  }
}

// Or the library would not be needed.
TEST_F(TracedProcess, TheKernelItselfRefusesACutState) {
  Bytes given = cut_state(state().size() - 8, 1);
  iovec part{given.data(), given.size()};
  errno = 0;
  EXPECT_EQ(ptrace(PTRACE_SETREGSET, process_, kExtendedState, &part), -1);
  EXPECT_EQ(errno, EFAULT);
}

TEST_F(TracedProcess, OfABufferThatIsLongerThanTheStateTheRestIsLeft) {
  unsigned seed = 10;
  for (const std::size_t more : {8U, 4'096U, 1U << 20U}) {
    Bytes given = cut_state(state().size(), ++seed);
    const Bytes expected = given;
    given.resize(given.size() + more, 0xFF);
    EXPECT_EQ(set_by_ours(given), 0) << std::strerror(errno);
    EXPECT_EQ(state(), expected) << more;
  }
}

TEST_F(TracedProcess, AStateThatTheKernelRefusesIsRefused) {
  Bytes given = cut_state(kAvxEnd, 4);
  given[kHeader + 8] = 1;  // a compacted format, which no one may set
  const Bytes before = state();
  errno = 0;
  EXPECT_EQ(set_by_ours(given), -1);
  EXPECT_EQ(errno, EINVAL);
  EXPECT_EQ(state(), before);
}

TEST_F(TracedProcess, EveryOtherRequestIsThatOfTheCLibrary) {
  Bytes cut(kAvxEnd);
  iovec part{cut.data(), cut.size()};
  EXPECT_EQ(ours_(PTRACE_GETREGSET, process_, kExtendedState, &part), 0);
  Bytes expected = state();
  expected.resize(part.iov_len);
  EXPECT_EQ(cut, expected);
  static const long word = -1;  // a value that looks like a failure, at the same place in the child
  void* const place = const_cast<long*>(&word);
  errno = EINVAL;
  EXPECT_EQ(ours_(PTRACE_PEEKDATA, process_, place, nullptr), -1);
  EXPECT_EQ(errno, 0);
}

TEST_F(TracedProcess, AProcessThatIsNotTracedIsAnError) {
  Bytes given = cut_state(kAvxEnd, 5);
  iovec part{given.data(), given.size()};
  errno = 0;
  EXPECT_EQ(ours_(PTRACE_SETREGSET, getpid(), kExtendedState, &part), -1);
  EXPECT_EQ(errno, ESRCH);
}

}  // namespace
}  // namespace pitwall::can_bus

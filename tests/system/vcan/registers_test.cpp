// Vector registers of the processes of a guest, whose kernel changes between them by itself.
// SPDX-License-Identifier: Apache-2.0
#include <dlfcn.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <random>

namespace pitwall {
namespace {

struct alignas(64) Registers {
  std::array<std::uint8_t, 32 * 64> bytes{};
};

// Loads registers, makes a system call with two arguments four times, and stores what the registers
// hold then.
using Through = void (*)(const Registers& in, Registers& out, long call, long first, long second);

[[gnu::noinline, gnu::target("avx")]] void avx_through(const Registers& in, Registers& out,
                                                       long call, long first, long second) {
  asm volatile(
      ".irp n,0,1,2,3,4,5,6,7,8,9,10,11,12,13,14,15\n vmovdqu 32*\\n(%0), %%ymm\\n\n.endr\n"
      ".rept 4\n mov %2, %%rax\n syscall\n.endr\n"
      ".irp n,0,1,2,3,4,5,6,7,8,9,10,11,12,13,14,15\n vmovdqu %%ymm\\n, 32*\\n(%1)\n.endr\n"
      "vzeroupper\n"
      :
      : "r"(in.bytes.data()), "r"(out.bytes.data()), "r"(call), "D"(first), "S"(second)
      : "memory", "rax", "rcx", "r11", "xmm0", "xmm1", "xmm2", "xmm3", "xmm4", "xmm5", "xmm6",
        "xmm7", "xmm8", "xmm9", "xmm10", "xmm11", "xmm12", "xmm13", "xmm14", "xmm15");
}

[[gnu::noinline, gnu::target("avx512f")]] void avx512_through(const Registers& in, Registers& out,
                                                              long call, long first, long second) {
  asm volatile(
      ".irp n,0,1,2,3,4,5,6,7,8,9,10,11,12,13,14,15,16,17,18,19,20,21,22,23,24,25,26,27,28,29,30,"
      "31\n vmovdqu64 64*\\n(%0), %%zmm\\n\n.endr\n"
      ".rept 4\n mov %2, %%rax\n syscall\n.endr\n"
      ".irp n,0,1,2,3,4,5,6,7,8,9,10,11,12,13,14,15,16,17,18,19,20,21,22,23,24,25,26,27,28,29,30,"
      "31\n vmovdqu64 %%zmm\\n, 64*\\n(%1)\n.endr\n"
      "vzeroupper\n"
      :
      : "r"(in.bytes.data()), "r"(out.bytes.data()), "r"(call), "D"(first), "S"(second)
      : "memory", "rax", "rcx", "r11", "xmm0", "xmm1", "xmm2", "xmm3", "xmm4", "xmm5", "xmm6",
        "xmm7", "xmm8", "xmm9", "xmm10", "xmm11", "xmm12", "xmm13", "xmm14", "xmm15");
}

// How often a process found its registers changed.
int changes(Through through, std::size_t used, unsigned seed, long call, long first, long second) {
  constexpr int kRounds = 500;
  std::mt19937 random(seed);
  int changed = 0;
  for (int round = 0; round < kRounds; ++round) {
    Registers in, out;
    for (std::size_t i = 0; i < used; ++i) in.bytes[i] = static_cast<std::uint8_t>(random());
    through(in, out, call, first, second);
    changed += std::memcmp(&in, &out, used) == 0 ? 0 : 1;
  }
  return changed;
}

// Several at once on whatever processors there are, one in a guest: each hands over to the others
// while its registers are full.
void expect_kept_among_processes(Through through, std::size_t used) {
  constexpr int kProcesses = 4;
  for (unsigned seed = 1; seed <= kProcesses; ++seed)
    if (fork() == 0) _exit(changes(through, used, seed, SYS_sched_yield, 0, 0) == 0 ? 0 : 1);
  for (int i = 0; i < kProcesses; ++i) {
    int status = -1;
    ASSERT_GT(wait(&status), 0);
    EXPECT_EQ(status, 0);
  }
}

TEST(VectorRegisters, AvxIsKeptWhileOtherProcessesRun) {
  if (__builtin_cpu_supports("avx") == 0) GTEST_SKIP() << "this processor has no AVX";
  expect_kept_among_processes(avx_through, 16 * 32);
}

TEST(VectorRegisters, Avx512IsKeptWhileOtherProcessesRun) {
  if (__builtin_cpu_supports("avx512f") == 0) GTEST_SKIP() << "this processor has no AVX-512";
  expect_kept_among_processes(avx512_through, 32 * 64);
}

[[gnu::target("avx")]] void clear_registers(int) { asm volatile("vzeroall"); }

// Of AVX-512 a guest keeps no more than that: hil/can_bus/init_script.cpp.
TEST(VectorRegisters, AvxIsKeptWhileASignalIsHandled) {
  if (__builtin_cpu_supports("avx") == 0) GTEST_SKIP() << "this processor has no AVX";
  const auto before = signal(SIGUSR1, clear_registers);
  EXPECT_EQ(changes(avx_through, 16 * 32, 1, SYS_kill, getpid(), SIGUSR1), 0);
  signal(SIGUSR1, before);
}

// A call of a string function with registers 16 to 31 full.
struct Call {
  const std::uint8_t* in;
  std::uint8_t* out;
  void* function;
};

[[gnu::noinline, gnu::target("avx512f")]] void call_through(const Call& call, void* first,
                                                            const void* second, std::size_t third) {
  asm volatile(
      "mov 0(%3), %%rax\n"
      ".irp n,16,17,18,19,20,21,22,23,24,25,26,27,28,29,30,31\n"
      " vmovdqu64 64*\\n(%%rax), %%zmm\\n\n.endr\n"
      "mov %%rsp, %%r12\n sub $256, %%rsp\n and $-64, %%rsp\n"
      "call *16(%3)\n mov %%r12, %%rsp\n mov 8(%3), %%rax\n"
      ".irp n,16,17,18,19,20,21,22,23,24,25,26,27,28,29,30,31\n"
      " vmovdqu64 %%zmm\\n, 64*\\n(%%rax)\n.endr\n"
      "vzeroupper\n"
      : "+D"(first), "+S"(second), "+d"(third)
      : "b"(&call)
      : "memory", "cc", "rax", "rcx", "r8", "r9", "r10", "r11", "r12", "xmm0", "xmm1", "xmm2",
        "xmm3", "xmm4", "xmm5", "xmm6", "xmm7", "xmm8", "xmm9", "xmm10", "xmm11", "xmm12", "xmm13",
        "xmm14", "xmm15");
}

// Or a handler that uses strings would spoil those of the process that it interrupts.
TEST(VectorRegisters, StringFunctionsLeaveAloneWhatASignalLoses) {
  if (__builtin_cpu_supports("avx512f") == 0) GTEST_SKIP() << "this processor has no AVX-512";
  if (std::getenv("PITWALL_GUEST") == nullptr) GTEST_SKIP() << "only a guest's signals lose it";
  Registers in, out;
  for (std::size_t i = 0; i < in.bytes.size(); ++i) in.bytes[i] = static_cast<std::uint8_t>(i * 7);
  const Registers before = in;
  for (const char* name : {"memcpy", "memmove", "memset", "memcmp", "strlen", "strcmp", "strcpy"}) {
    const Call call{in.bytes.data(), out.bytes.data(), dlsym(RTLD_DEFAULT, name)};
    ASSERT_NE(call.function, nullptr) << name;
    for (const std::size_t length : {5U, 20U, 40U, 100U, 300U, 3'000U}) {
      std::array<char, 4'096> from{}, to{};
      std::memset(from.data(), 'x', length);
      std::memset(to.data(), 'x', length);
      call_through(call, to.data(), from.data(), length);
      EXPECT_EQ(std::memcmp(&out.bytes[16 * 64], &before.bytes[16 * 64], 16 * 64), 0)
          << name << ", " << length << " bytes";
    }
  }
}

}  // namespace
}  // namespace pitwall

// SPDX-License-Identifier: Apache-2.0
// Keeps bench time as a bench does: bench_keeper FILE. Lets it stand after "stand" and go on after
// "go", read from standard input, until that ends. Says "keeps" when it begins.
#include <unistd.h>

#include <array>
#include <cstdio>
#include <string>
#include <string_view>

#include "protocol/transport/bench_clock/clock_keeper.hpp"
#include "protocol/transport/clock.hpp"
#include "protocol/transport/readiness.hpp"

namespace pitwall {
namespace {

int keep(const std::string& file) {
  auto keeper = transport::ClockKeeper::keep(file);
  if (!keeper) {
    std::fprintf(stderr, "%s\n", to_string(keeper.error()).c_str());
    return 1;
  }
  keeper->begin();
  std::puts("keeps");
  std::fflush(stdout);
  bool stands = false;
  while (true) {
    const std::array watched{STDIN_FILENO};
    if (transport::wait_readable(watched, transport::monotonic_now() + milliseconds(1)) != 0) {
      std::array<std::uint8_t, 64> stated{};
      const auto got = transport::read_now(STDIN_FILENO, stated);
      if (got.ended) return 0;
      stands = stated[0] == 's';
    }
    if (!stands) keeper->advance();
  }
}

}  // namespace
}  // namespace pitwall

int main(int argc, char** argv) { return argc == 2 ? pitwall::keep(argv[1]) : 2; }

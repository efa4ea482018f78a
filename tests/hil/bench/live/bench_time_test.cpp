// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/live/bench_time.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <cstdlib>

#include "hil/can_bus/clock_message.hpp"
#include "protocol/transport/clock.hpp"
#include "protocol/transport/file.hpp"

namespace pitwall::bench {
namespace {

using can_bus::decode_clock;
using can_bus::encode_clock;
using transport::SerialLine;

// A bench whose line ends in a terminal of this test.
struct LineEnd {
  transport::TemporaryFolder folder = *transport::TemporaryFolder::create("pitwall-bench-time-");
  std::string file = folder.path() + "/clock";
  transport::FileDescriptor master{::posix_openpt(O_RDWR | O_NOCTTY)};
  std::string tty() const {
    ::grantpt(master.get());
    ::unlockpt(master.get());
    return ::ptsname(master.get());
  }
};

bool advance(BenchTime& time, const std::string& file) {
  const auto memory = transport::ClockMemory::open(file);
  return time.advance(Instant::max(), transport::bench_now(memory->page(), transport::wall_now));
}

// Lets `time` go for `wall`, with `answer` to each word of it.
template <class Answer>
void go(BenchTime& time, const std::string& file, SerialLine& host, Duration wall,
        Answer&& answer) {
  const Instant end = transport::wall_now() + wall;
  while (transport::wall_now() < end) {
    advance(time, file);
    while (const auto word = host.receive())
      if (const auto now = decode_clock(*word)) answer(*now);
    transport::nap(microseconds(200));
  }
}

TEST(BenchTime, GoesNoFartherThanItsHostHasFollowed) {
  LineEnd bench;
  auto time = BenchTime::open(bench.file, bench.tty());
  ASSERT_TRUE(time) << to_string(time.error());
  SerialLine host = *SerialLine::adopt(std::move(bench.master));
  auto memory = transport::ClockMemory::open(bench.file);
  const auto now = [&] { return transport::bench_now(memory->page(), transport::wall_now); };
  const Instant begun = now();
  time->begin();
  go(*time, bench.file, host, milliseconds(150), [](Instant) {});
  EXPECT_LE(now() - begun, BenchTime::kBehind + milliseconds(1)) << "nobody answers";
  EXPECT_GE(now() - begun, BenchTime::kBehind - BenchTime::kReportPeriod);
  EXPECT_FALSE(advance(*time, bench.file));
  std::uint64_t words = 0;
  go(*time, bench.file, host, milliseconds(300), [&](Instant at) {
    ++words;
    host.send(encode_clock(at));
    host.flush();
  });
  host.send(encode_clock(now()));
  host.flush();
  go(*time, bench.file, host, milliseconds(100), [](Instant) {});
  EXPECT_GT(now() - begun, BenchTime::kBehind + milliseconds(15)) << "it goes on when followed";
  EXPECT_GE(time->waits().longest, milliseconds(100));
  time->end();
  bool ended = false;
  go(*time, bench.file, host, milliseconds(1),
     [&](Instant at) { ended = ended || at == Instant::max(); });
  EXPECT_TRUE(ended);
}

TEST(BenchTime, WithoutALineThereIsNobodyToWaitFor) {
  LineEnd bench;
  auto time = BenchTime::open(bench.file, "");
  ASSERT_TRUE(time);
  EXPECT_FALSE(BenchTime::open(bench.file, "")) << "kept already";
  EXPECT_FALSE(BenchTime::open(bench.folder.path() + "/other", "/no/such/tty"));
  time->begin();
  EXPECT_TRUE(advance(*time, bench.file));
}

}  // namespace
}  // namespace pitwall::bench

// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/protocol_comparison/tun_link.hpp"

#include <algorithm>
#include <array>

#include "protocol/transport/clock.hpp"
#include "protocol/transport/readiness.hpp"
#include "protocol/transport/realtime.hpp"

namespace pitwall::benchmarks {
namespace {

constexpr Duration kLongestSleep = milliseconds(50);  // so that stop() is heard
constexpr int kPriority = 40;
constexpr std::size_t kBuffer = 65'536;
constexpr std::size_t kPacketsAtFirst = 1U << 16U;

DirectionTally roomy() {
  DirectionTally tally;
  tally.offered.reserve(kPacketsAtFirst);
  tally.late.reserve(kPacketsAtFirst);
  return tally;
}

link::LinkParams for_whole_packets(link::LinkParams params) {
  params.overhead_bytes = 0;
  return params;
}

}  // namespace

TunLink::TunLink(transport::TunNetwork& car, transport::TunNetwork& base,
                 const link::LinkParams& down, const link::LinkParams& up, std::uint64_t seed,
                 Instant start)
    : start_(start),
      tally_{roomy(), roomy()},
      down_{car, base, {for_whole_packets(down), seed}, tally_.down},
      up_{base, car, {for_whole_packets(up), seed}, tally_.up},
      buffer_(kBuffer),
      thread_([this] { run(); }) {}

const LinkTally& TunLink::stop() {
  stopping_ = true;
  if (thread_.joinable()) thread_.join();
  tally_.down.counters = down_.emulator.counters();
  tally_.up.counters = up_.emulator.counters();
  return tally_;
}

void TunLink::run() {
  transport::request_realtime(kPriority);
  while (!stopping_) {
    Instant wake = transport::monotonic_now() + kLongestSleep;
    for (const Direction* direction : {&down_, &up_})
      if (const auto next = direction->emulator.next())
        wake = std::min(wake, start_ + (*next - Instant{}));
    const std::array watched{down_.from.fd(), up_.from.fd()};
    transport::wait_readable(watched, wake);
    take_in(down_);
    take_in(up_);
    give_out(down_);
    give_out(up_);
  }
}

void TunLink::take_in(Direction& direction) {
  while (const auto packet = direction.from.read(buffer_)) {
    const Instant now = Instant{} + (transport::monotonic_now() - start_);
    direction.tally.offered.push_back({now, packet->size()});
    direction.emulator.offer(*packet, now);
  }
}

void TunLink::give_out(Direction& direction) {
  const Instant now = Instant{} + (transport::monotonic_now() - start_);
  while (const auto packet = direction.emulator.take(now)) {
    direction.tally.late.push_back(now - packet->arrives);
    if (!direction.to.write(packet->bytes)) ++direction.tally.refused;
  }
}

}  // namespace pitwall::benchmarks

// SPDX-License-Identifier: Apache-2.0
// Any frame is refused or decoded by every generated struct; what is decoded is finite, and sending
// it again gives the same values unless a limit held one. And any row, any protection, any frames
// at any time leave a monitor whose figures agree.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "protocol/can/av21.hpp"
#include "protocol/can/message_monitor.hpp"
#include "protocol/vocabulary/check.hpp"

namespace {

using namespace pitwall;
using namespace pitwall::can;

template <class X>
void try_message(const Frame& frame) {
  X seen;
  if (!av21::decode(frame, seen)) return;
  for (const auto field : X::kFields) CHECK(std::isfinite(seen.*field));
  Frame sent;
  EncodeCounters counters;
  CHECK(av21::encode(seen, sent, counters));
  X again;
  CHECK(av21::decode(sent, again));
  if (counters.saturated > 0) return;
  for (const auto field : X::kFields) CHECK(seen.*field == again.*field);
}

template <class... X>
void try_all(const Frame& frame, const std::tuple<X...>&) {
  (try_message<X>(frame), ...);
}

// A row that a manifest could give: checksum at the front, counter in the byte after it.
MessageRow row_of(const std::uint8_t* bytes) {
  MessageRow row{};
  const bool is_wide = bytes[0] % 5 == 4;
  row.length = static_cast<std::uint8_t>(4 + bytes[1] % 61);
  row.period = microseconds(bytes[2] * 1000);
  row.timeout = row.period * (bytes[3] % 8);
  row.has_counter = true;
  row.counter_start = is_wide ? 16 : 8;
  row.counter_bits = is_wide ? 8 : 4;
  row.protection = {.profile = static_cast<Protection>(bytes[0] % 5),
                    .data_id_mode = static_cast<DataIdMode>(bytes[0] / 5 % 4),
                    .length = row.length,
                    .counter_start = row.counter_start,
                    .counter_bits = row.counter_bits,
                    .nibble_start = 12,
                    .data_id = static_cast<std::uint16_t>(bytes[2] | bytes[3] << 8U)};
  if (row.protection.profile == Protection::kNone) row.has_counter = (bytes[1] & 1U) != 0;
  return row;
}

void agree(const MonitorRules& rules, const MessageMonitor& monitor, const LossLog& losses,
           std::uint64_t reported) {
  CHECK(monitor.debt <= 2 * rules.fault_debt);
  CHECK(losses.count <= LossLog::kMax);
  CHECK(monitor.listed <= monitor.reported);
  // All that was reported is still lost, or was late; a silence counts more than it lists.
  const std::uint64_t unlisted = monitor.reported - monitor.listed;
  CHECK(losses.unlisted > 0 || reported + unlisted == std::uint64_t{monitor.lost} + monitor.late);
}

// Four bytes of row, then per event: what happens, how much later, the counter, a byte of data.
void try_monitor(const std::uint8_t* bytes, std::size_t size) {
  const MessageRow row = row_of(bytes);
  const MonitorRules rules{.use_counter = (bytes[1] & 2U) != 0};
  MessageMonitor monitor;
  LossLog losses;
  Instant now{1'000'000'000};
  std::uint64_t reported = 0;
  for (std::size_t i = 4; i + 4 <= size && i < 400; i += 4) {
    now += microseconds((bytes[i + 1] - 16) * 250);  // sometimes backwards
    Frame frame{.length = row.length, .data = {}};
    frame.data[2] = frame.data[3] = bytes[i + 3];
    frame.data[row.counter_start / 8] = bytes[i + 2];
    ProtectState sender{bytes[i + 2] % (counter_top(row.protection) + 1)};
    protect(row.protection, sender, frame);
    CHECK(check(row.protection, frame) == FrameCheck::kOk);
    if ((bytes[i] & 1U) != 0) frame.data[bytes[i + 3] % 4] ^= bytes[i + 2];
    if ((bytes[i] & 2U) != 0) static_cast<void>(judge(row, rules, monitor, {frame, now}, losses));
    if ((bytes[i] & 4U) != 0) watch({&row, 1}, {&monitor, 1}, now, losses);
    for (const LossReport& report : losses.listed()) {
      CHECK(report.frames > 0);
      reported += report.frames;
    }
    losses.clear();
    agree(rules, monitor, losses, reported);
  }
}

}  // namespace

// Two bytes of id, one of flags and length, then data; also tried with every known id and length.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  if (size < 4) return 0;
  Frame frame;
  frame.id = (bytes[0] | static_cast<std::uint32_t>(bytes[1]) << 8U) & 0xFFFU;
  frame.extended = (bytes[2] & 1U) != 0;
  frame.remote = (bytes[2] & 2U) != 0;
  frame.fd = (bytes[2] & 4U) != 0;
  frame.length = bytes[3] % (kMaxDataBytes + 1);
  std::memcpy(frame.data.data(), bytes + 4, std::min(size - 4, kMaxDataBytes));
  try_all(frame, av21::AllMessages{});
  const MessageRow& row = av21::kMessages[bytes[0] % av21::kMessages.size()];
  frame = {.id = row.id,
           .extended = false,
           .remote = false,
           .fd = false,
           .length = row.length,
           .data = frame.data};
  try_all(frame, av21::AllMessages{});
  try_monitor(bytes, size);
  return 0;
}

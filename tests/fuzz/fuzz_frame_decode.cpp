// SPDX-License-Identifier: Apache-2.0
// Any frame is refused or decoded by every generated struct; what is decoded is finite, and sending
// it again gives the same values unless a limit held one.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "protocol/can/av21.hpp"
#include "protocol/vocabulary/check.hpp"

namespace {

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
  return 0;
}

// SPDX-License-Identifier: Apache-2.0
// Any bytes, cut as the first byte says, give the same messages as in one piece, each of them
// refused with a reason or decoded; what is decoded is written again to the byte unless it has
// fields that we step over. The bytes are also sent as header and payload with a good checksum.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "protocol/bits/crc.hpp"
#include "protocol/gnss/vectornav_stream.hpp"
#include "protocol/vocabulary/check.hpp"

namespace {

using namespace pitwall;
using namespace pitwall::gnss;
using Bytes = std::vector<std::uint8_t>;

bool is_writable(const VectorNavOutput& output) {
  for (std::size_t i = 0; i < kVectorNavGroups; ++i) {
    if ((output.fields[i] & ~writable_fields(static_cast<VectorNavGroup>(i))) != 0) return false;
  }
  return true;
}

// The common group repeats fields of the others: where both are sent, the later one is kept.
bool says_all_once(const VectorNavOutput& output) {
  const bool others = std::any_of(output.fields.begin() + 1, output.fields.end(),
                                  [](std::uint32_t mask) { return mask != 0; });
  return output.of(VectorNavGroup::kCommon) == 0 || !others;
}

struct Seen {
  std::size_t messages = 0;
  StreamCounters counters;
};

Seen see(std::span<const std::uint8_t> bytes, std::size_t piece) {
  Seen seen;
  VectorNavStream stream;
  for (; !bytes.empty(); bytes = bytes.subspan(std::min(piece, bytes.size()))) {
    stream.feed(bytes.first(std::min(piece, bytes.size())), [&](const VectorNavFrame& frame) {
      ++seen.messages;
      const auto message = decode(frame);
      if (!message) {
        CHECK(!text(message.error()).empty());
        return;
      }
      if (!is_writable(frame.output)) return;
      Bytes written(kMaxVectorNavBytes);
      const std::size_t n = encode(*message, written);
      CHECK(n > frame.payload.size() + kVectorNavCrcBytes);
      const auto payload = written.begin() + static_cast<std::ptrdiff_t>(n - kVectorNavCrcBytes -
                                                                         frame.payload.size());
      if (says_all_once(frame.output))
        CHECK(std::equal(frame.payload.begin(), frame.payload.end(), payload));
      VectorNavStream again{std::span{&frame.output, 1}};
      std::size_t frames = 0;
      again.feed(std::span{written}.first(n), [&](const VectorNavFrame& second) {
        ++frames;
        CHECK(decode(second).has_value());
      });
      CHECK(frames == 1);
    });
  }
  seen.counters = stream.counters();
  return seen;
}

void try_with_checksum(std::span<const std::uint8_t> bytes) {
  Bytes frame{kVectorNavSync};
  frame.insert(frame.end(), bytes.begin(), bytes.end());
  const auto header = read_vectornav_header(frame);
  if (!header || header->header_bytes == 0) return;
  frame.resize(header->frame_bytes() - kVectorNavCrcBytes, 0x3F);
  const std::uint16_t crc = bits::crc16_ccitt_false(std::span{frame}.subspan(1), 0);
  frame.push_back(static_cast<std::uint8_t>(crc >> 8U));
  frame.push_back(static_cast<std::uint8_t>(crc & 0xFFU));
  CHECK(see(frame, frame.size()).messages == 1);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  if (size < 2) return 0;
  const std::span<const std::uint8_t> rest{bytes + 1, size - 1};
  const Seen whole = see(rest, rest.size()), cut = see(rest, 1U + bytes[0]);
  CHECK(whole.messages == cut.messages);
  CHECK(whole.counters.garbage_bytes == cut.counters.garbage_bytes);
  CHECK(whole.counters.bad_crc == cut.counters.bad_crc);
  try_with_checksum(rest);
  return 0;
}

// SPDX-License-Identifier: Apache-2.0
// Any bytes, cut as the first byte says, give the same frames as in one piece, each of them refused
// with a reason or decoded; what is decoded is written again as the same log. Every second input is
// also sent as the body of a log of every kind behind a good header and checksum.
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "protocol/bits/crc.hpp"
#include "protocol/gnss/little_endian.hpp"
#include "protocol/gnss/novatel_stream.hpp"
#include "protocol/vocabulary/check.hpp"

namespace {

using namespace pitwall;
using namespace pitwall::gnss;
using Bytes = std::span<const std::uint8_t>;

// A frame that decodes is written as a log that decodes to the same bytes again.
void check_again(const NovatelHeader& header, const NovatelMessage& message) {
  std::array<std::uint8_t, kMaxEncodedBytes> first{}, second{};
  const std::size_t n = encode(header, message, first);
  NovatelStream stream;
  int frames = 0;
  stream.feed(Bytes{first}.first(n), [&](const NovatelFrame& frame) {
    ++frames;
    const auto again = decode(frame);
    CHECK(again.has_value());
    CHECK(encode(frame.header, *again, second) == n);
  });
  CHECK(frames == 1 && first == second);
}

struct Seen {
  std::vector<std::uint16_t> ids;
  StreamCounters counters;
};

Seen see(Bytes bytes, std::size_t piece) {
  Seen seen;
  NovatelStream stream;
  for (; !bytes.empty(); bytes = bytes.subspan(std::min(piece, bytes.size()))) {
    stream.feed(bytes.first(std::min(piece, bytes.size())), [&](const NovatelFrame& frame) {
      seen.ids.push_back(frame.header.id);
      const auto decoded = decode(frame);
      if (!decoded) {
        CHECK(!text(decoded.error()).empty());
        return;
      }
      NovatelHeader header = frame.header;
      header.message_type = 0;
      check_again(header, *decoded);
    });
  }
  seen.counters = stream.counters();
  return seen;
}

void try_body(std::uint16_t id, Bytes body) {
  std::vector<std::uint8_t> bytes(kLongHeaderBytes + body.size() + kCrcBytes);
  const NovatelHeader header{.id = id};
  const std::size_t at = encode_header(header, static_cast<std::uint16_t>(body.size()), bytes);
  std::copy(body.begin(), body.end(), bytes.begin() + static_cast<std::ptrdiff_t>(at));
  const std::size_t covered = at + body.size();
  ByteWriter{std::span{bytes}.subspan(covered)}.put(
      bits::crc32_novatel(Bytes{bytes}.first(covered)));
  CHECK(see(bytes, bytes.size()).ids == std::vector{id});
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  constexpr std::array<std::uint16_t, 23> kIds{42,   93,   99,   101,  268,  325,  507,  508,
                                               726,  812,  813,  1335, 1362, 1457, 1461, 1462,
                                               1465, 1945, 2042, 2051, 2052, 2264, 1163};
  constexpr std::size_t kLongest = 1'000;
  if (size < 2) return 0;
  const Bytes rest{bytes + 1, size - 1};
  const Seen whole = see(rest, rest.size()), cut = see(rest, 1U + bytes[0]);
  CHECK(whole.ids == cut.ids);
  CHECK(whole.counters.garbage_bytes == cut.counters.garbage_bytes);
  CHECK(whole.counters.bytes == rest.size());
  if (rest.size() <= kLongest) try_body(kIds[bytes[0] % kIds.size()], rest);
  return 0;
}

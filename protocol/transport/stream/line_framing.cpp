// SPDX-License-Identifier: Apache-2.0
#include "protocol/transport/stream/line_framing.hpp"

#include <algorithm>
#include <cstring>

#include "protocol/bits/crc.hpp"
#include "protocol/vocabulary/bytes.hpp"
#include "protocol/vocabulary/check.hpp"

namespace pitwall::transport {
namespace {

std::uint32_t frame_crc(std::span<const std::uint8_t> length_bytes,
                        std::span<const std::uint8_t> payload) {
  return bits::crc32_ieee(payload, bits::crc32_ieee(length_bytes));
}

}  // namespace

std::uint8_t line_crc8(std::span<const std::uint8_t> bytes) {
  unsigned c = 0;
  for (const std::uint8_t byte : bytes) {
    c ^= byte;
    for (int bit = 0; bit < 8; ++bit) c = (c & 0x80U) != 0U ? ((c << 1U) ^ 0x07U) & 0xFFU : c << 1U;
  }
  return static_cast<std::uint8_t>(c);
}

std::size_t encode_line_frame(std::span<const std::uint8_t> datagram,
                              std::span<std::uint8_t, kMaxLineFrameBytes> out) {
  if (datagram.size() > kMaxLineDatagramBytes) return 0;
  const auto n = datagram.size();
  out[0] = kLineMagic[0];
  out[1] = kLineMagic[1];
  store(out, 2, static_cast<std::uint16_t>(n));
  out[4] = line_crc8(out.first<4>());
  std::copy(datagram.begin(), datagram.end(), out.begin() + kLineHeaderBytes);
  store(out, kLineHeaderBytes + n, frame_crc(out.subspan<2, 2>(), datagram));
  return kLineHeaderBytes + n + kLineTrailerBytes;
}

std::span<std::uint8_t> LineDecoder::free_space() {
  compact();
  return {buffer_.data() + end_, buffer_.size() - end_};
}

void LineDecoder::filled(std::size_t bytes) {
  CHECK(bytes <= buffer_.size() - end_);
  end_ += bytes;
}

std::size_t LineDecoder::feed(std::span<const std::uint8_t> bytes) {
  const auto space = free_space();
  const std::size_t n = std::min(space.size(), bytes.size());
  std::copy_n(bytes.begin(), n, space.begin());
  filled(n);
  return n;
}

std::optional<std::span<const std::uint8_t>> LineDecoder::next() {
  while (true) {
    skip_foreign();
    const auto bytes = pending();
    if (bytes.size() < kLineHeaderBytes) return std::nullopt;
    const std::size_t length = load<std::uint16_t>(bytes, 2);
    if (line_crc8(bytes.first(4)) != bytes[4] || length > kMaxLineDatagramBytes) {
      ++counters_.bad_header;
      ++counters_.foreign_bytes;
      ++begin_;
      continue;
    }
    const std::size_t whole = kLineHeaderBytes + length + kLineTrailerBytes;
    if (bytes.size() < whole) return std::nullopt;
    const auto payload = bytes.subspan(kLineHeaderBytes, length);
    const auto stored = load<std::uint32_t>(bytes, kLineHeaderBytes + length);
    if (stored != frame_crc(bytes.subspan(2, 2), payload)) {
      ++counters_.bad_crc;
      ++counters_.foreign_bytes;
      ++begin_;
      continue;
    }
    begin_ += whole;
    ++counters_.datagrams;
    return payload;
  }
}

// To the next magic, or to a last byte that may be the first half of one.
void LineDecoder::skip_foreign() {
  while (end_ - begin_ >= 2 &&
         (buffer_[begin_] != kLineMagic[0] || buffer_[begin_ + 1] != kLineMagic[1])) {
    ++begin_;
    ++counters_.foreign_bytes;
  }
  if (end_ - begin_ == 1 && buffer_[begin_] != kLineMagic[0]) {
    ++begin_;
    ++counters_.foreign_bytes;
  }
}

void LineDecoder::compact() {
  std::memmove(buffer_.data(), buffer_.data() + begin_, end_ - begin_);
  end_ -= begin_;
  begin_ = 0;
}

}  // namespace pitwall::transport

// Framing of datagrams on a serial line that may also carry foreign bytes (the console of a kernel,
// a boot loader):
//
//   A7 5C | length u16 LE | header check u8 | payload | CRC-32 LE of length and payload
//
// Foreign or damaged bytes destroy only the datagrams that contain them: the decoder searches the
// next magic from the byte after a false one. Pure: bytes in, datagrams out.
//   units  bytes, at most kMaxLineDatagramBytes per datagram
//   errors counters only
//   source CRC-32 of bits/crc.hpp; CRC-8 SMBUS (check "123456789" = F4)
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace pitwall::transport {

inline constexpr std::size_t kMaxLineDatagramBytes = 2'048;
inline constexpr std::size_t kLineHeaderBytes = 5;
inline constexpr std::size_t kLineTrailerBytes = 4;
inline constexpr std::size_t kMaxLineFrameBytes =
    kLineHeaderBytes + kMaxLineDatagramBytes + kLineTrailerBytes;
inline constexpr std::array<std::uint8_t, 2> kLineMagic{0xA7, 0x5C};

std::uint8_t line_crc8(std::span<const std::uint8_t> bytes);

// Writes the framed datagram to `out` and returns its length; 0 if it is longer than allowed.
std::size_t encode_line_frame(std::span<const std::uint8_t> datagram,
                              std::span<std::uint8_t, kMaxLineFrameBytes> out);

struct LineDecoderCounters {
  std::uint64_t datagrams = 0;
  std::uint64_t foreign_bytes = 0;  // skipped in the search for a datagram
  std::uint64_t bad_header = 0;     // magic with a wrong header check
  std::uint64_t bad_crc = 0;
};

class LineDecoder {
 public:
  // Free part of the buffer; the caller writes there, then calls filled() and next().
  std::span<std::uint8_t> free_space();
  void filled(std::size_t bytes);
  // Copies as many bytes as fit and returns their number.
  std::size_t feed(std::span<const std::uint8_t> bytes);
  // The next complete datagram; valid until free_space(), filled() or feed() is called.
  std::optional<std::span<const std::uint8_t>> next();
  const LineDecoderCounters& counters() const { return counters_; }

 private:
  std::span<const std::uint8_t> pending() const { return {buffer_.data() + begin_, end_ - begin_}; }
  void skip_foreign();
  void compact();

  std::array<std::uint8_t, 4 * kMaxLineFrameBytes> buffer_{};
  std::size_t begin_ = 0, end_ = 0;
  LineDecoderCounters counters_;
};

}  // namespace pitwall::transport

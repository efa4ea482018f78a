// SPDX-License-Identifier: Apache-2.0
// Any text between sync and '*', given its checksum, is no log, a log that is refused with a
// reason, or one that is written again, read again and then the same to the byte. Also the text as
// the fields of every log.
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <string>
#include <string_view>

#include "protocol/bits/crc.hpp"
#include "protocol/gnss/novatel_ascii.hpp"
#include "protocol/gnss/novatel_names.hpp"
#include "protocol/gnss/novatel_stream.hpp"
#include "protocol/vocabulary/check.hpp"

namespace {

using namespace pitwall;
using namespace pitwall::gnss;

std::span<const std::uint8_t> bytes_of(std::string_view text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

std::string sentence_of(char sync, const std::string& between) {
  std::array<char, 9> crc{};
  std::snprintf(crc.data(), crc.size(), "%08x", bits::crc32_novatel(bytes_of(between)));
  return sync + between + "*" + crc.data() + "\r\n";
}

std::string written(const NovatelHeader& header, const NovatelMessage& message) {
  std::array<std::uint8_t, kMaxAsciiBytes> out{};
  const std::size_t n = encode_ascii(header, message, out);
  return {out.begin(), out.begin() + static_cast<std::ptrdiff_t>(n)};
}

void try_sentence(const std::string& sentence) {
  NovatelStream stream;
  stream.feed(bytes_of(sentence), [&](const NovatelFrame& frame) {
    if (!frame.ascii) return;  // recordings are among the seeds
    const auto decoded = decode(frame);
    if (!decoded) {
      CHECK(!text(decoded.error()).empty());
      return;
    }
    CHECK(!log_name(frame.header.id).empty());
    NovatelHeader header = frame.header;
    const std::string first = written(header, *decoded);
    NovatelStream again;
    int frames = 0;
    again.feed(bytes_of(first), [&](const NovatelFrame& second) {
      ++frames;
      const auto same = decode(second);
      CHECK(same.has_value());
      CHECK(written(second.header, *same) == first);
    });
    CHECK(frames == 1);
  });
  CHECK(stream.counters().bytes == sentence.size());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  constexpr std::array<const char*, 9> kLong{"BESTPOS", "BESTVEL", "HEADING2",
                                             "INSPVAX", "RAWIMUX", "RXSTATUS",
                                             "TIME",    "BESTUTM", "DUALANTENNAHEADING"};
  constexpr std::array<const char*, 4> kShort{"RAWIMUSX", "INSPVAS", "CORRIMUDATAS", "CORRIMUS"};
  const std::string text{reinterpret_cast<const char*>(bytes), size};
  try_sentence(text);  // the text as it came
  try_sentence(sentence_of(kAsciiLong, text));
  try_sentence(sentence_of(kAsciiShort, text));
  for (const char* name : kLong) {
    const std::string header = "A,COM1_7,3,53.5,FINESTEERING,2175,235409.017,02004820,46eb,32768;";
    try_sentence(sentence_of(kAsciiLong, name + header + text));
  }
  for (const char* name : kShort) {
    const std::string header = "A,2209,491674.014;";
    try_sentence(sentence_of(kAsciiShort, name + header + text));
  }
  return 0;
}

// SPDX-License-Identifier: Apache-2.0
#include "protocol/gnss/vectornav_stream.hpp"

#include <algorithm>

#include "protocol/bits/crc.hpp"

namespace pitwall::gnss {

VectorNavStream::VectorNavStream(std::span<const VectorNavOutput> expected) {
  for (const VectorNavOutput& output : expected) CHECK(expected_.push(output));
}

bool VectorNavStream::next(VectorNavFrame& frame) {
  while (true) {
    const auto bytes = window_.unread();
    const auto sync = std::find(bytes.begin(), bytes.end(), kVectorNavSync);
    discard(static_cast<std::size_t>(sync - bytes.begin()));
    const auto unread = window_.unread();
    if (unread.empty()) return false;
    const auto header = read_vectornav_header(unread);
    if (header && header->header_bytes == 0) return false;
    const bool known = header && header->frame_bytes() <= kMaxVectorNavBytes;
    if (!known) ++counters_.bad_header;
    const bool expected = known && is_expected(header->output);
    if (known && !expected) ++counters_.unexpected;
    if (!expected) {
      discard(1);
      continue;
    }
    if (unread.size() < header->frame_bytes()) return false;
    const auto whole = unread.first(header->frame_bytes());
    // Over the message and its own CRC the remainder is zero.
    if (bits::crc16_ccitt_false(whole.subspan(1), 0) != 0) {
      ++counters_.bad_crc;
      discard(1);
      continue;
    }
    frame = {.output = header->output,
             .payload = whole.subspan(header->header_bytes, header->payload_bytes),
             .bytes = whole.size()};
    window_.take_off(whole.size());
    ++counters_.frames;
    out_of_sync_ = false;
    return true;
  }
}

bool VectorNavStream::is_expected(const VectorNavOutput& output) const {
  return expected_.empty() ||
         std::find(expected_.begin(), expected_.end(), output) != expected_.end();
}

void VectorNavStream::discard(std::size_t n) {
  window_.take_off(n);
  counters_.garbage_bytes += n;
  if (n > 0 && !out_of_sync_) ++counters_.resyncs;
  out_of_sync_ = out_of_sync_ || n > 0;
}

}  // namespace pitwall::gnss

// SPDX-License-Identifier: Apache-2.0
#include "protocol/recording/mcap_wire.hpp"

#include "protocol/vocabulary/bytes.hpp"

namespace pitwall::recording {

void McapAppender::string(std::string_view v) {
  u32(static_cast<std::uint32_t>(v.size()));
  out_.insert(out_.end(), v.begin(), v.end());
}

std::size_t McapAppender::begin_record(McapOpcode opcode) {
  const std::size_t begin = out_.size();
  u8(static_cast<std::uint8_t>(opcode));
  u64(0);
  return begin;
}

void McapAppender::end_record_around(std::size_t begin, std::size_t more) {
  patch(begin + 1, out_.size() - begin - kMcapRecordHeaderBytes + more, sizeof(std::uint64_t));
}

std::size_t McapAppender::begin_block() {
  const std::size_t begin = out_.size();
  u32(0);
  return begin;
}

void McapAppender::end_block(std::size_t begin) {
  patch(begin, out_.size() - begin - sizeof(std::uint32_t), sizeof(std::uint32_t));
}

void McapAppender::little_endian(std::uint64_t v, std::size_t bytes) {
  for (std::size_t i = 0; i < bytes; ++i) out_.push_back(static_cast<std::uint8_t>(v >> (8 * i)));
}

void McapAppender::patch(std::size_t at, std::uint64_t v, std::size_t bytes) {
  store(std::span(out_).subspan(at, bytes), v);
}

std::span<const std::uint8_t> McapCursor::bytes(std::uint64_t count) {
  if (!ok_ || count > rest_.size()) {
    ok_ = false;
    return {};
  }
  const auto taken = rest_.first(static_cast<std::size_t>(count));
  rest_ = rest_.subspan(taken.size());
  return taken;
}

std::string_view McapCursor::string() {
  const auto taken = bytes(u32());
  return {reinterpret_cast<const char*>(taken.data()), taken.size()};
}

std::uint64_t McapCursor::little_endian(std::size_t count) { return load(bytes(count)); }

}  // namespace pitwall::recording

// Wire format of MCAP version 0: opcodes, and little-endian fields in memory.
//   in     values (McapAppender), bytes from any source (McapCursor)
//   errors a cursor that reads past the end returns zeros, and ok() stays false; it never reads
//          outside of its bytes
//   source https://mcap.dev/spec
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace pitwall::recording {

inline constexpr std::array<std::uint8_t, 8> kMcapMagic{0x89, 'M', 'C', 'A', 'P', '0', '\r', '\n'};
inline constexpr std::size_t kMcapRecordHeaderBytes = 9;  // opcode, length

enum class McapOpcode : std::uint8_t {
  kHeader = 0x01,
  kFooter = 0x02,
  kSchema = 0x03,
  kChannel = 0x04,
  kMessage = 0x05,
  kChunk = 0x06,
  kMessageIndex = 0x07,
  kChunkIndex = 0x08,
  kAttachment = 0x09,
  kAttachmentIndex = 0x0A,
  kStatistics = 0x0B,
  kMetadata = 0x0C,
  kMetadataIndex = 0x0D,
  kSummaryOffset = 0x0E,
  kDataEnd = 0x0F,
};

// Appends to a vector of the caller; does not allocate if the caller has reserved enough.
class McapAppender {
 public:
  explicit McapAppender(std::vector<std::uint8_t>& out) : out_(out) {}

  void u8(std::uint8_t v) { out_.push_back(v); }
  void u16(std::uint16_t v) { little_endian(v, sizeof v); }
  void u32(std::uint32_t v) { little_endian(v, sizeof v); }
  void u64(std::uint64_t v) { little_endian(v, sizeof v); }
  void bytes(std::span<const std::uint8_t> v) { out_.insert(out_.end(), v.begin(), v.end()); }
  void string(std::string_view v);
  // Writes the opcode of a record and reserves its length, which end_record() fills in.
  std::size_t begin_record(McapOpcode opcode);
  void end_record(std::size_t begin) { end_record_around(begin, 0); }
  // The same for a record whose last `more` bytes are written later.
  void end_record_around(std::size_t begin, std::size_t more);
  // Reserves the length in bytes of a map or array, which end_block() fills in.
  std::size_t begin_block();
  void end_block(std::size_t begin);

 private:
  void little_endian(std::uint64_t v, std::size_t bytes);
  void patch(std::size_t at, std::uint64_t v, std::size_t bytes);

  std::vector<std::uint8_t>& out_;
};

class McapCursor {
 public:
  explicit McapCursor(std::span<const std::uint8_t> bytes) : rest_(bytes) {}

  std::uint8_t u8() { return static_cast<std::uint8_t>(little_endian(1)); }
  std::uint16_t u16() { return static_cast<std::uint16_t>(little_endian(2)); }
  std::uint32_t u32() { return static_cast<std::uint32_t>(little_endian(4)); }
  std::uint64_t u64() { return little_endian(8); }
  std::span<const std::uint8_t> bytes(std::uint64_t count);
  std::string_view string();  // u32 length, then that many bytes
  bool ok() const { return ok_; }
  std::span<const std::uint8_t> rest() const { return rest_; }

 private:
  std::uint64_t little_endian(std::size_t count);

  std::span<const std::uint8_t> rest_;
  bool ok_ = true;
};

}  // namespace pitwall::recording

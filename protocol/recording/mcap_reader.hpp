// Reader of an MCAP file (version 0) in memory, from front to back: whole files, files of a process
// that died, and any other bytes.
//   in     bytes; they must outlive the reader and what it hands out
//   out    messages in the order of the file; channels and schemas as they become known
//   errors a file that is cut or broken delivers everything before that place; end() tells the
//          reason and the place. A chunk whose CRC is wrong, or that is compressed, is skipped as a
//          whole and counted. Messages of a chunk that the cut goes through are delivered, though
//          its CRC cannot be checked; they are counted as unverified, and skipped where their
//          time is none of the chunk's
//   cost   O(bytes); allocates for channels and schemas only
//   source https://mcap.dev/spec
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>

#include "protocol/recording/mcap_writer.hpp"

namespace pitwall::recording {

struct McapMessage {
  std::uint16_t channel = 0;  // key of McapReader::channels()
  std::uint32_t sequence = 0;
  std::uint64_t logged_ns = 0, published_ns = 0;
  std::span<const std::uint8_t> data;
};

enum class McapEnd : std::uint8_t {
  kReading,    // there may be more
  kComplete,   // footer and closing magic are there
  kNoMagic,    // not an MCAP file
  kTruncated,  // ends inside a record, or without a footer
  kMalformed,  // a record whose inside contradicts its length
};

struct McapReaderCounters {
  std::uint64_t messages = 0;
  std::uint64_t unverified = 0;  // of those, without a CRC that could be checked
  std::uint64_t chunks = 0;
  std::uint64_t bad_chunk_crc = 0;      // chunks skipped
  std::uint64_t compressed_chunks = 0;  // chunks skipped
  std::uint64_t bad_data_crc = 0, bad_summary_crc = 0;
  std::uint64_t unknown_channel = 0;  // messages skipped
  std::uint64_t implausible = 0;      // skipped: in a cut chunk, outside of the time that it names
  std::uint64_t other_records = 0;    // of kinds that carry no message: passed over
};

class McapReader {
 public:
  explicit McapReader(std::span<const std::uint8_t> file);

  // The next message, or none: then end() tells why.
  std::optional<McapMessage> next();

  McapEnd end() const { return end_; }
  // Where reading stopped: bytes from the start of the file.
  std::uint64_t place() const { return place_; }
  const McapReaderCounters& counters() const { return counters_; }
  const std::map<std::uint16_t, Channel>& channels() const { return channels_; }
  // The metadata record "run" that the writer puts in front.
  const Metadata& run() const { return run_; }

 private:
  struct Record {
    McapOpcode opcode{};
    std::span<const std::uint8_t> content;
    bool cut = false;  // the file ends inside it
  };

  std::uint64_t place_of(std::span<const std::uint8_t> rest) const;
  std::optional<McapMessage> stop(McapEnd end, std::uint64_t place);
  static std::optional<Record> take_record(std::span<const std::uint8_t>& from);
  std::optional<McapMessage> next_in_chunk();
  std::optional<McapMessage> read_message(const Record& record, bool verified);
  bool read(const Record& record);
  bool read_schema(const Record& record);
  bool read_channel(const Record& record);
  bool read_metadata(const Record& record);
  bool read_data_end(const Record& record);
  bool read_footer(const Record& record);
  bool open_chunk(const Record& record);

  std::span<const std::uint8_t> file_, rest_, chunk_;
  bool in_chunk_ = false, chunk_verified_ = false, chunk_cut_ = false;
  std::uint64_t chunk_start_ns_ = 0, chunk_end_ns_ = 0;
  McapEnd end_ = McapEnd::kReading;
  std::uint64_t place_ = 0;
  McapReaderCounters counters_;
  std::map<std::uint16_t, Schema> schemas_;
  std::map<std::uint16_t, Channel> channels_;
  Metadata run_;
};

const char* to_string(McapEnd end);

}  // namespace pitwall::recording

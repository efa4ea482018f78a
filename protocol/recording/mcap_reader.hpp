// Reader of an MCAP file (version 0) in memory, from front to back: whole files, files of a killed
// process, and any other bytes.
//   in     bytes, which must outlive the reader and its results; an optional function that
//          decompresses chunks: without it compressed chunks are skipped
//   out    messages in the order of the file; channels and schemas as they are read, or at once
//          from an intact summary
//   errors a cut file gives everything before the cut; end() has the reason, place() the place.
//          After an inconsistent record reading continues at the next chunk in an intact summary. A
//          chunk with a wrong CRC, or that cannot be decompressed, is skipped as a whole; of an
//          inconsistent chunk the rest is skipped. gaps() lists each of them. Messages of a chunk
//          that the end of the file cuts are returned, although its CRC cannot be checked; they
//          count as unverified, and are skipped if their time is outside that of the chunk
//   cost   O(bytes); allocates only for channels, schemas, gaps and the index of a summary
//   source https://mcap.dev/spec
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/recording/mcap_writer.hpp"
#include "protocol/vocabulary/result.hpp"

namespace pitwall::recording {

struct McapMessage {
  std::uint16_t channel = 0;  // key of McapReader::channels()
  std::uint32_t sequence = 0;
  std::uint64_t logged_ns = 0, published_ns = 0;
  std::span<const std::uint8_t> data;
};

enum class McapEnd : std::uint8_t {
  kReading,    // there may be more
  kComplete,   // with footer and closing magic
  kNoMagic,    // not an MCAP file
  kTruncated,  // ends inside a record, or without a footer
  kMalformed,  // a record whose content contradicts its length
};

struct McapReaderCounters {
  std::uint64_t messages = 0;
  std::uint64_t unverified = 0;  // of those, without a CRC that could be checked
  std::uint64_t chunks = 0;
  std::uint64_t bad_chunk_crc = 0;      // chunks skipped
  std::uint64_t compressed_chunks = 0;  // chunks skipped: not decompressed
  std::uint64_t broken_chunks = 0;      // chunks whose rest was skipped
  std::uint64_t bytes_skipped = 0;      // of broken chunks, and up to the next chunk
  std::uint64_t bad_data_crc = 0, bad_summary_crc = 0;
  std::uint64_t unknown_channel = 0;  // messages skipped
  std::uint64_t implausible = 0;      // messages skipped: in a cut chunk, outside of its time range
  std::uint64_t other_records = 0;    // skipped records of kinds that carry no message
};

// Skipped bytes: their offset in the file, their number, and the reason.
struct McapGap {
  std::uint64_t place = 0, bytes = 0;
  std::string what;
};

// Returns the decompressed chunk, which must outlive everything read from it, or the error.
using Decompress = std::function<Result<std::span<const std::uint8_t>, std::string>(
    std::string_view compression, std::span<const std::uint8_t> bytes, std::uint64_t plain_bytes)>;

class McapReader {
 public:
  explicit McapReader(std::span<const std::uint8_t> file, Decompress decompress = {});

  // The next message; nullopt at the end, for which end() has the reason.
  std::optional<McapMessage> next();

  McapEnd end() const { return end_; }
  // Where reading stopped: offset in the file.
  std::uint64_t place() const { return place_; }
  // Offset of the newest message; for one in a compressed chunk, that of the chunk.
  std::uint64_t message_place() const { return message_place_; }
  const McapReaderCounters& counters() const { return counters_; }
  const std::vector<McapGap>& gaps() const { return gaps_; }
  const std::map<std::uint16_t, Channel>& channels() const { return channels_; }
  // The metadata record "run", which the writer puts first.
  const Metadata& run() const { return run_; }

 private:
  struct Record {
    McapOpcode opcode{};
    std::span<const std::uint8_t> content;
    bool cut = false;  // the file ends inside it
  };

  std::uint64_t place_of(std::span<const std::uint8_t> rest) const;
  // The same for bytes of the open chunk; for a compressed chunk, the offset of its record.
  std::uint64_t place_in_chunk(std::span<const std::uint8_t> rest) const;
  void skip_damaged(std::uint64_t place, std::uint64_t bytes, std::string what);
  void read_summary();
  void read_summary_record(const Record& record);
  bool resume_after(std::uint64_t place);
  std::optional<McapMessage> stop_or_go_on(McapEnd end, std::uint64_t place);
  std::optional<McapMessage> leave_chunk(std::uint64_t place);
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
  bool decompress_chunk(const Record& record, std::string_view compression,
                        std::uint64_t plain_bytes);

  std::span<const std::uint8_t> file_, rest_, chunk_;
  Decompress decompress_;
  std::vector<McapGap> gaps_;
  std::vector<std::uint64_t> chunk_places_;  // from the summary, ascending
  std::uint64_t chunk_place_ = 0;            // offset of the record of the open chunk
  bool in_chunk_ = false, chunk_verified_ = false, chunk_cut_ = false, chunk_compressed_ = false;
  std::uint64_t chunk_start_ns_ = 0, chunk_end_ns_ = 0;
  McapEnd end_ = McapEnd::kReading;
  std::uint64_t place_ = 0, message_place_ = 0;
  McapReaderCounters counters_;
  std::map<std::uint16_t, Schema> schemas_;
  std::map<std::uint16_t, Channel> channels_;
  Metadata run_;
};

const char* to_string(McapEnd end);

}  // namespace pitwall::recording

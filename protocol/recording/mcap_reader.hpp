// Reader of an MCAP file (version 0) in memory, from front to back: whole files, files of a process
// that died, and any other bytes.
//   in     bytes, which must outlive the reader and what it hands out; who decompresses chunks:
//          nobody, and a compressed chunk is skipped
//   out    messages in the order of the file; channels and schemas as they become known, those of
//          an intact summary at once
//   errors a file that is cut delivers everything before that place; end() tells the reason and the
//          place. Behind a record that contradicts itself reading goes on at the next chunk that
//          an intact summary names. A chunk whose CRC is wrong, or that cannot be decompressed, is
//          skipped as a whole; of a chunk that contradicts itself the rest is. gaps() tells each of
//          them. Messages of a chunk that the cut goes through are delivered, though its CRC
//          cannot be checked; they are counted as unverified, and skipped where their time is none
//          of the chunk's
//   cost   O(bytes); allocates for channels, schemas, gaps and the index of a summary only
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
  std::uint64_t compressed_chunks = 0;  // chunks skipped: nobody could decompress them
  std::uint64_t broken_chunks = 0;      // of which the rest was skipped
  std::uint64_t bytes_skipped = 0;      // of broken chunks, and on the way to the next chunk
  std::uint64_t bad_data_crc = 0, bad_summary_crc = 0;
  std::uint64_t unknown_channel = 0;  // messages skipped
  std::uint64_t implausible = 0;      // skipped: in a cut chunk, outside of the time that it names
  std::uint64_t other_records = 0;    // of kinds that carry no message: passed over
};

// What was passed over: bytes from the start of the file, how many, and why.
struct McapGap {
  std::uint64_t place = 0, bytes = 0;
  std::string what;
};

// The bytes of a compressed chunk as they were; they must outlive what is read of them. Or why not.
using Decompress = std::function<Result<std::span<const std::uint8_t>, std::string>(
    std::string_view compression, std::span<const std::uint8_t> bytes, std::uint64_t plain_bytes)>;

class McapReader {
 public:
  explicit McapReader(std::span<const std::uint8_t> file, Decompress decompress = {});

  // The next message, or none: then end() tells why.
  std::optional<McapMessage> next();

  McapEnd end() const { return end_; }
  // Where reading stopped: bytes from the start of the file.
  std::uint64_t place() const { return place_; }
  // Where the newest message lies; of one in a compressed chunk, where the chunk does.
  std::uint64_t message_place() const { return message_place_; }
  const McapReaderCounters& counters() const { return counters_; }
  const std::vector<McapGap>& gaps() const { return gaps_; }
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
  // The same of bytes of the open chunk; of a compressed one, where its record lies.
  std::uint64_t place_in_chunk(std::span<const std::uint8_t> rest) const;
  void pass_over(std::uint64_t place, std::uint64_t bytes, std::string what);
  void read_summary();
  void read_summary_record(const Record& record);
  bool go_on_behind(std::uint64_t place);
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
  std::vector<std::uint64_t> chunk_places_;  // by the summary, rising
  std::uint64_t chunk_place_ = 0;            // of the record of the open chunk
  bool in_chunk_ = false, chunk_verified_ = false, chunk_cut_ = false, chunk_apart_ = false;
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

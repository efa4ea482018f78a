// Writer of an MCAP file (version 0, uncompressed chunks) to a sink.
//   in     channels and metadata at construction; then messages, each with its time
//   out    bytes, in order, to the sink: magic, header, metadata, schemas, channels, then chunks
//          with CRC-32 and message indexes; close() adds data end, summary and footer.
//          The same input gives the same bytes.
//   units  times are Instants (ns on the run's own clock); sequences count per channel from 0
//   errors a message for an unknown channel, before time zero, or larger than a chunk is refused
//          and counted. After a failure of the sink the file has a gap, so all later messages are
//          refused
//   cost   O(size of the message); memory for one chunk, its indexes and the summary of
//          `limits.chunks` chunks is reserved at construction. A run with more chunks continues,
//          and then allocates at a flush, never at a message
//   source https://mcap.dev/spec
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "protocol/recording/mcap_wire.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::recording {

// Stores bytes; false: they were not stored (disk full, connection lost).
using Sink = std::function<bool(std::span<const std::uint8_t>)>;

struct Schema {
  std::string name;      // "pitwall_msgs/msg/EgoSample"; empty: the channel has no schema
  std::string encoding;  // "ros2msg", "jsonschema"
  std::string text;

  bool operator==(const Schema&) const = default;
};

using Metadata = std::vector<std::pair<std::string, std::string>>;

struct Channel {
  std::string topic;
  std::string message_encoding;  // "cdr", "json"
  Schema schema;
  Metadata metadata;
};

// Position of a channel in the list given to the writer, and its id in the file.
struct ChannelId {
  std::uint16_t index = 0;
};

struct McapLimits {
  std::size_t chunk_bytes = 1 << 18;  // also the largest message record
  std::size_t messages_per_chunk = 1 << 14;
  Duration chunk_span = seconds(1);  // a crash loses at most this much
  std::size_t chunks = 4096;         // reserved in the summary: more than an hour
};

// Stamps and sequence of a message in another file, which a copy must not change.
struct McapStamps {
  Instant logged{}, published{};
  std::uint32_t sequence = 0;
};

struct McapCounters {
  std::uint64_t messages = 0;
  std::uint64_t bytes = 0;  // accepted by the sink
  std::uint64_t chunks = 0;
  std::uint64_t refused_channel = 0, refused_time = 0, refused_size = 0, refused_sink = 0,
                refused_closed = 0;

  std::uint64_t refused() const {
    return refused_channel + refused_time + refused_size + refused_sink + refused_closed;
  }
};

class McapWriter {
 public:
  McapWriter(std::vector<Channel> channels, const Metadata& run, Sink sink, McapLimits limits = {});

  // False: refused and counted by reason.
  bool write(ChannelId channel, Instant at, std::span<const std::uint8_t> data);
  // `published`: when the sender created the message; `logged`: when it was recorded.
  bool write(ChannelId channel, Instant logged, Instant published,
             std::span<const std::uint8_t> data);
  bool copy(ChannelId channel, const McapStamps& stamps, std::span<const std::uint8_t> data);
  // Writes the open chunk to the sink; false if the sink has failed, now or before.
  bool flush();
  // Flushes and writes the summary; false if the sink has failed. Later calls do nothing.
  bool close();
  const McapCounters& counters() const { return counters_; }

 private:
  struct IndexEntry {
    std::uint16_t channel;
    std::uint64_t at_ns, offset;
  };
  struct ChannelTally {
    std::uint32_t next_sequence = 0;
    std::uint64_t messages = 0;
  };

  bool refuse(std::uint64_t& counter);
  bool admits(ChannelId channel, Instant logged, Instant published, std::size_t record_bytes);
  bool emit(std::span<const std::uint8_t> bytes);
  std::uint16_t schema_id(std::size_t channel) const;
  void append_schemas(McapAppender& out) const;
  void append_channels(McapAppender& out) const;
  void append_statistics(McapAppender& out) const;
  void write_preamble(const Metadata& run);
  void begin_chunk(Instant at);
  bool end_chunk();
  bool write_message_indexes(std::uint64_t chunk_start_offset);
  bool write_summary();

  std::vector<Channel> channels_;
  Sink sink_;
  McapLimits limits_;
  McapCounters counters_;
  std::vector<ChannelTally> tallies_;
  std::vector<std::uint8_t> chunk_;          // message records of the open chunk
  std::vector<std::uint8_t> scratch_;        // one group of records before it goes to the sink
  std::vector<std::uint8_t> chunk_indexes_;  // summary records of the chunks so far
  std::vector<std::uint8_t> metadata_index_;
  std::vector<IndexEntry> index_;
  std::uint64_t chunk_start_ns_ = 0, chunk_end_ns_ = 0, run_start_ns_ = 0, run_end_ns_ = 0;
  std::uint32_t crc_ = 0;  // of every byte so far
  bool failed_ = false, closed_ = false;
};

}  // namespace pitwall::recording

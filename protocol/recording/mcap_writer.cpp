// SPDX-License-Identifier: Apache-2.0
#include "protocol/recording/mcap_writer.hpp"

#include <algorithm>
#include <string_view>
#include <tuple>

#include "protocol/bits/crc.hpp"
#include "protocol/vocabulary/check.hpp"

namespace pitwall::recording {
namespace {

constexpr std::size_t kMessageFixedBytes = 2 + 4 + 8 + 8;  // channel, sequence, log, publish time
constexpr std::size_t kIndexEntryBytes = 8 + 8;            // time, offset
constexpr std::size_t kChunkIndexFixedBytes = kMcapRecordHeaderBytes + 8 * 7 + 4 * 2;
constexpr std::size_t kChannelOffsetBytes = 2 + 8;
constexpr std::string_view kLibrary = "pitwall";

void append_pairs(McapAppender& out, const Metadata& pairs) {
  const std::size_t block = out.begin_block();
  for (const auto& [key, value] : pairs) {
    out.string(key);
    out.string(value);
  }
  out.end_block(block);
}

std::uint64_t as_ns(Instant at) { return static_cast<std::uint64_t>(at.ns); }

}  // namespace

McapWriter::McapWriter(std::vector<Channel> channels, const Metadata& run, Sink sink,
                       McapLimits limits)
    : channels_(std::move(channels)),
      sink_(std::move(sink)),
      limits_(limits),
      tallies_(channels_.size()) {
  CHECK(channels_.size() < 0xFFFF);
  CHECK(limits_.chunk_bytes > 0 && limits_.messages_per_chunk > 0);
  const std::size_t per_channel = kMcapRecordHeaderBytes + 2 + 4;
  chunk_.reserve(limits_.chunk_bytes);
  index_.reserve(limits_.messages_per_chunk);
  scratch_.reserve(std::max<std::size_t>(
      channels_.size() * per_channel + limits_.messages_per_chunk * kIndexEntryBytes, 1 << 12));
  chunk_indexes_.reserve(limits_.chunks *
                         (kChunkIndexFixedBytes + channels_.size() * kChannelOffsetBytes));
  write_preamble(run);
}

bool McapWriter::write(ChannelId channel, Instant at, std::span<const std::uint8_t> data) {
  return write(channel, at, at, data);
}

bool McapWriter::write(ChannelId channel, Instant logged, Instant published,
                       std::span<const std::uint8_t> data) {
  const bool known = channel.index < tallies_.size();
  const std::uint32_t sequence = known ? tallies_[channel.index].next_sequence : 0;
  return copy(channel, {.logged = logged, .published = published, .sequence = sequence}, data);
}

bool McapWriter::copy(ChannelId channel, const McapStamps& stamps,
                      std::span<const std::uint8_t> data) {
  const Instant logged = stamps.logged, published = stamps.published;
  const std::size_t record_bytes = kMcapRecordHeaderBytes + kMessageFixedBytes + data.size();
  if (!admits(channel, logged, published, record_bytes)) return false;
  const bool full = chunk_.size() + record_bytes > limits_.chunk_bytes ||
                    index_.size() == limits_.messages_per_chunk;
  const bool spent =
      !index_.empty() &&
      Instant{static_cast<std::int64_t>(chunk_start_ns_)} + limits_.chunk_span <= logged;
  if ((full || spent) && !flush()) return refuse(counters_.refused_sink);

  if (index_.empty()) begin_chunk(logged);
  chunk_start_ns_ = std::min(chunk_start_ns_, as_ns(logged));
  chunk_end_ns_ = std::max(chunk_end_ns_, as_ns(logged));
  index_.push_back({channel.index, as_ns(logged), chunk_.size()});
  ChannelTally& tally = tallies_[channel.index];
  McapAppender out{chunk_};
  const std::size_t record = out.begin_record(McapOpcode::kMessage);
  out.u16(channel.index);
  out.u32(stamps.sequence);
  out.u64(as_ns(logged));
  out.u64(as_ns(published));
  out.bytes(data);
  out.end_record(record);
  tally.next_sequence = stamps.sequence + 1;
  ++tally.messages;
  ++counters_.messages;
  return true;
}

bool McapWriter::flush() {
  if (failed_) return false;
  if (index_.empty()) return true;
  failed_ = !end_chunk();
  chunk_.clear();
  index_.clear();
  return !failed_;
}

bool McapWriter::close() {
  if (closed_) return !failed_;
  const bool flushed = flush();
  closed_ = true;
  if (!flushed) return false;
  scratch_.clear();
  McapAppender out{scratch_};
  const std::size_t record = out.begin_record(McapOpcode::kDataEnd);
  out.u32(crc_);
  out.end_record(record);
  failed_ = !emit(scratch_) || !write_summary();
  return !failed_;
}

bool McapWriter::refuse(std::uint64_t& counter) {
  ++counter;
  return false;
}

bool McapWriter::admits(ChannelId channel, Instant logged, Instant published,
                        std::size_t record_bytes) {
  if (closed_) return refuse(counters_.refused_closed);
  if (failed_) return refuse(counters_.refused_sink);
  if (channel.index >= channels_.size()) return refuse(counters_.refused_channel);
  if (logged < Instant{} || published < Instant{}) return refuse(counters_.refused_time);
  if (record_bytes > limits_.chunk_bytes) return refuse(counters_.refused_size);
  return true;
}

bool McapWriter::emit(std::span<const std::uint8_t> bytes) {
  if (!sink_(bytes)) return false;
  crc_ = bits::crc32_ieee(bytes, crc_);
  counters_.bytes += bytes.size();
  return true;
}

std::uint16_t McapWriter::schema_id(std::size_t channel) const {
  const Schema& wanted = channels_[channel].schema;
  if (wanted.name.empty()) return 0;
  for (std::size_t i = 0;; ++i) {
    if (channels_[i].schema == wanted) return static_cast<std::uint16_t>(i + 1);
  }
}

void McapWriter::append_schemas(McapAppender& out) const {
  for (std::size_t i = 0; i < channels_.size(); ++i) {
    if (schema_id(i) != i + 1) continue;
    const Schema& schema = channels_[i].schema;
    const std::size_t record = out.begin_record(McapOpcode::kSchema);
    out.u16(schema_id(i));
    out.string(schema.name);
    out.string(schema.encoding);
    out.string(schema.text);
    out.end_record(record);
  }
}

void McapWriter::append_channels(McapAppender& out) const {
  for (std::size_t i = 0; i < channels_.size(); ++i) {
    const std::size_t record = out.begin_record(McapOpcode::kChannel);
    out.u16(static_cast<std::uint16_t>(i));
    out.u16(schema_id(i));
    out.string(channels_[i].topic);
    out.string(channels_[i].message_encoding);
    append_pairs(out, channels_[i].metadata);
    out.end_record(record);
  }
}

void McapWriter::write_preamble(const Metadata& run) {
  McapAppender out{scratch_};
  out.bytes(kMcapMagic);
  const std::size_t header = out.begin_record(McapOpcode::kHeader);
  out.string("");  // no profile
  out.string(kLibrary);
  out.end_record(header);
  if (!run.empty()) {
    const std::size_t record = out.begin_record(McapOpcode::kMetadata);
    out.string("run");
    append_pairs(out, run);
    out.end_record(record);
    McapAppender index{metadata_index_};
    const std::size_t index_record = index.begin_record(McapOpcode::kMetadataIndex);
    index.u64(record);
    index.u64(scratch_.size() - record);
    index.string("run");
    index.end_record(index_record);
  }
  append_schemas(out);
  append_channels(out);
  failed_ = !emit(scratch_);
}

void McapWriter::begin_chunk(Instant at) {
  chunk_start_ns_ = chunk_end_ns_ = as_ns(at);
  if (counters_.messages == 0) run_start_ns_ = run_end_ns_ = as_ns(at);
}

bool McapWriter::end_chunk() {
  run_start_ns_ = std::min(run_start_ns_, chunk_start_ns_);
  run_end_ns_ = std::max(run_end_ns_, chunk_end_ns_);
  const std::uint64_t chunk_start_offset = counters_.bytes;
  scratch_.clear();
  McapAppender out{scratch_};
  const std::size_t record = out.begin_record(McapOpcode::kChunk);
  out.u64(chunk_start_ns_);
  out.u64(chunk_end_ns_);
  out.u64(chunk_.size());
  out.u32(bits::crc32_ieee(chunk_));
  out.string("");  // not compressed
  out.u64(chunk_.size());
  out.end_record_around(record, chunk_.size());
  ++counters_.chunks;
  return emit(scratch_) && emit(chunk_) && write_message_indexes(chunk_start_offset);
}

bool McapWriter::write_message_indexes(std::uint64_t chunk_start_offset) {
  // By channel, then time; equal times stay in the order of the file.
  std::sort(index_.begin(), index_.end(), [](const IndexEntry& a, const IndexEntry& b) {
    return std::tie(a.channel, a.at_ns, a.offset) < std::tie(b.channel, b.at_ns, b.offset);
  });
  const std::uint64_t indexes_offset = counters_.bytes;
  scratch_.clear();
  McapAppender out{scratch_};
  McapAppender summary{chunk_indexes_};
  const std::size_t chunk_index = summary.begin_record(McapOpcode::kChunkIndex);
  summary.u64(chunk_start_ns_);
  summary.u64(chunk_end_ns_);
  summary.u64(chunk_start_offset);
  summary.u64(indexes_offset - chunk_start_offset);
  const std::size_t offsets = summary.begin_block();
  for (std::size_t i = 0; i < index_.size();) {
    const std::uint16_t channel = index_[i].channel;
    summary.u16(channel);
    summary.u64(indexes_offset + scratch_.size());
    const std::size_t record = out.begin_record(McapOpcode::kMessageIndex);
    out.u16(channel);
    const std::size_t entries = out.begin_block();
    for (; i < index_.size() && index_[i].channel == channel; ++i) {
      out.u64(index_[i].at_ns);
      out.u64(index_[i].offset);
    }
    out.end_block(entries);
    out.end_record(record);
  }
  summary.end_block(offsets);
  summary.u64(scratch_.size());
  summary.string("");  // not compressed
  summary.u64(chunk_.size());
  summary.u64(chunk_.size());
  summary.end_record(chunk_index);
  return emit(scratch_);
}

void McapWriter::append_statistics(McapAppender& out) const {
  std::uint16_t schemas = 0;
  for (std::size_t i = 0; i < channels_.size(); ++i) {
    if (schema_id(i) == i + 1) ++schemas;
  }
  const std::size_t record = out.begin_record(McapOpcode::kStatistics);
  out.u64(counters_.messages);
  out.u16(schemas);
  out.u32(static_cast<std::uint32_t>(channels_.size()));
  out.u32(0);  // attachments
  out.u32(metadata_index_.empty() ? 0 : 1);
  out.u32(static_cast<std::uint32_t>(counters_.chunks));
  out.u64(run_start_ns_);
  out.u64(run_end_ns_);
  const std::size_t counts = out.begin_block();
  for (std::size_t i = 0; i < tallies_.size(); ++i) {
    out.u16(static_cast<std::uint16_t>(i));
    out.u64(tallies_[i].messages);
  }
  out.end_block(counts);
  out.end_record(record);
}

// Summary: the groups of records, then where each group lies, then the footer, whose CRC covers
// everything from the summary's first byte to its own.
bool McapWriter::write_summary() {
  const std::uint64_t summary_start = counters_.bytes;
  std::vector<std::uint8_t> summary, group_offsets;
  McapAppender out{summary}, groups{group_offsets};
  const auto group = [&](McapOpcode opcode, auto&& append) {
    const std::size_t begin = summary.size();
    append();
    if (summary.size() == begin) return;
    const std::size_t record = groups.begin_record(McapOpcode::kSummaryOffset);
    groups.u8(static_cast<std::uint8_t>(opcode));
    groups.u64(summary_start + begin);
    groups.u64(summary.size() - begin);
    groups.end_record(record);
  };
  group(McapOpcode::kSchema, [&] { append_schemas(out); });
  group(McapOpcode::kChannel, [&] { append_channels(out); });
  group(McapOpcode::kStatistics, [&] { append_statistics(out); });
  group(McapOpcode::kChunkIndex, [&] { out.bytes(chunk_indexes_); });
  group(McapOpcode::kMetadataIndex, [&] { out.bytes(metadata_index_); });
  const std::uint64_t offsets_start = summary_start + summary.size();
  out.bytes(group_offsets);
  const std::size_t footer = out.begin_record(McapOpcode::kFooter);
  out.u64(summary_start);
  out.u64(offsets_start);
  out.end_record_around(footer, sizeof(std::uint32_t));
  out.u32(bits::crc32_ieee(summary));
  out.bytes(kMcapMagic);
  return emit(summary);
}

}  // namespace pitwall::recording

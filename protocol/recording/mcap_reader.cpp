// SPDX-License-Identifier: Apache-2.0
#include "protocol/recording/mcap_reader.hpp"

#include <algorithm>

#include "protocol/bits/crc.hpp"

namespace pitwall::recording {
namespace {

// Where the summary and its offsets start, and the CRC.
constexpr std::size_t kFooterBytes = kMcapRecordHeaderBytes + 8 + 8 + 4;

Metadata read_pairs(McapCursor& from) {
  Metadata pairs;
  McapCursor block{from.bytes(from.u32())};
  while (from.ok() && !block.rest().empty()) {
    std::string key{block.string()}, value{block.string()};
    if (!block.ok()) {
      from.bytes(from.rest().size() + 1);  // a pair runs out of its block: the record is no good
      return {};
    }
    pairs.emplace_back(std::move(key), std::move(value));
  }
  return pairs;
}

}  // namespace

McapReader::McapReader(std::span<const std::uint8_t> file, Decompress decompress)
    : file_(file), rest_(file), decompress_(std::move(decompress)) {
  const auto magic = McapCursor{file}.bytes(kMcapMagic.size());
  if (!std::ranges::equal(magic, kMcapMagic)) {
    stop(McapEnd::kNoMagic, 0);
    return;
  }
  rest_ = file_.subspan(kMcapMagic.size());
  read_summary();
}

// Channels and places of chunks, where footer and summary are as they were written.
void McapReader::read_summary() {
  if (file_.size() < 2 * kMcapMagic.size() + kFooterBytes) return;
  const std::size_t footer = file_.size() - kMcapMagic.size() - kFooterBytes;
  McapCursor in{file_.subspan(footer)};
  const bool is_footer = in.u8() == static_cast<std::uint8_t>(McapOpcode::kFooter) &&
                         in.u64() == kFooterBytes - kMcapRecordHeaderBytes;
  const std::uint64_t start = in.u64();
  in.u64();  // where the summary offsets start
  const std::uint64_t crc_place = place_of(in.rest());
  const std::uint32_t crc = in.u32();
  if (!is_footer || !std::ranges::equal(in.rest(), kMcapMagic)) return;
  if (start < kMcapMagic.size() || start > footer) return;
  const auto begin = static_cast<std::size_t>(start);
  const auto covered = file_.subspan(begin, static_cast<std::size_t>(crc_place) - begin);
  if (crc != 0 && crc != bits::crc32_ieee(covered)) return;
  auto summary = file_.subspan(begin, footer - begin);
  for (auto record = take_record(summary); record && !record->cut; record = take_record(summary))
    read_summary_record(*record);
  std::ranges::sort(chunk_places_);
}

void McapReader::read_summary_record(const Record& record) {
  if (record.opcode == McapOpcode::kSchema) read_schema(record);
  if (record.opcode == McapOpcode::kChannel) read_channel(record);
  if (record.opcode != McapOpcode::kChunkIndex) return;
  McapCursor in{record.content};
  in.u64();  // first and
  in.u64();  // last time
  const std::uint64_t place = in.u64();
  const bool is_chunk =
      in.ok() && place < file_.size() &&
      file_[static_cast<std::size_t>(place)] == static_cast<std::uint8_t>(McapOpcode::kChunk);
  if (is_chunk) chunk_places_.push_back(place);
}

std::optional<McapMessage> McapReader::next() {
  while (end_ == McapEnd::kReading) {
    if (in_chunk_) {
      if (auto message = next_in_chunk()) return message;
      continue;
    }
    const std::uint64_t begin = place_of(rest_);
    const auto record = take_record(rest_);
    if (!record || (record->cut && record->opcode != McapOpcode::kChunk)) {
      stop_or_go_on(McapEnd::kTruncated, begin);
    } else if (record->opcode == McapOpcode::kMessage) {
      if (auto message = read_message(*record, false)) return message;
    } else if (!read(*record)) {
      stop_or_go_on(record->cut ? McapEnd::kTruncated : McapEnd::kMalformed, begin);
    }
  }
  return std::nullopt;
}

std::uint64_t McapReader::place_in_chunk(std::span<const std::uint8_t> rest) const {
  return chunk_compressed_ ? chunk_place_ : place_of(rest);
}

void McapReader::skip_damaged(std::uint64_t place, std::uint64_t bytes, std::string what) {
  gaps_.push_back({place, bytes, std::move(what)});
}

// To the next chunk that the summary names. False: it names none.
bool McapReader::resume_after(std::uint64_t place) {
  const auto next = std::ranges::upper_bound(chunk_places_, std::max(place, chunk_place_));
  if (next == chunk_places_.end()) return false;
  skip_damaged(place, *next - place, "bytes that contradict themselves");
  counters_.bytes_skipped += *next - place;
  rest_ = file_.subspan(static_cast<std::size_t>(*next));
  in_chunk_ = false;
  return true;
}

std::optional<McapMessage> McapReader::stop_or_go_on(McapEnd end, std::uint64_t place) {
  if (resume_after(place)) return std::nullopt;
  return stop(end, place);
}

// The rest of the open chunk contradicts itself.
std::optional<McapMessage> McapReader::leave_chunk(std::uint64_t place) {
  in_chunk_ = false;
  if (chunk_cut_) return stop_or_go_on(McapEnd::kTruncated, place);
  ++counters_.broken_chunks;
  const std::uint64_t bytes = chunk_compressed_ ? chunk_.size() : place_of(rest_) - place;
  counters_.bytes_skipped += bytes;
  skip_damaged(place, bytes, "rest of a chunk that contradicts itself");
  return std::nullopt;
}

std::uint64_t McapReader::place_of(std::span<const std::uint8_t> rest) const {
  return static_cast<std::uint64_t>(rest.data() - file_.data());
}

std::optional<McapMessage> McapReader::stop(McapEnd end, std::uint64_t place) {
  end_ = end;
  place_ = place;
  return std::nullopt;
}

std::optional<McapReader::Record> McapReader::take_record(std::span<const std::uint8_t>& from) {
  if (from.empty()) return std::nullopt;
  McapCursor cursor{from};
  Record record;
  const auto opcode = static_cast<McapOpcode>(cursor.u8());
  const std::uint64_t length = cursor.u64();
  if (!cursor.ok()) {
    record.cut = true;
  } else {
    record.opcode = opcode;
    record.cut = length > cursor.rest().size();
    record.content = cursor.bytes(std::min<std::uint64_t>(length, cursor.rest().size()));
  }
  from = cursor.rest();
  return record;
}

std::optional<McapMessage> McapReader::next_in_chunk() {
  const std::uint64_t begin = place_in_chunk(chunk_);
  const auto record = take_record(chunk_);
  if (!record && !chunk_cut_) {
    in_chunk_ = false;
    return std::nullopt;
  }
  if (!record || record->cut) return leave_chunk(begin);
  if (record->opcode == McapOpcode::kMessage) return read_message(*record, chunk_verified_);
  const bool fits = record->opcode == McapOpcode::kSchema || record->opcode == McapOpcode::kChannel;
  if (!fits || !read(*record)) return leave_chunk(begin);
  return std::nullopt;
}

std::optional<McapMessage> McapReader::read_message(const Record& record, bool verified) {
  McapCursor in{record.content};
  McapMessage message;
  message.channel = in.u16();
  message.sequence = in.u32();
  message.logged_ns = in.u64();
  message.published_ns = in.u64();
  message.data = in.rest();
  const std::uint64_t place = in_chunk_ ? place_in_chunk(record.content) : place_of(record.content);
  if (!in.ok()) return in_chunk_ ? leave_chunk(place) : stop_or_go_on(McapEnd::kMalformed, place);
  if (!channels_.contains(message.channel)) {
    ++counters_.unknown_channel;
    skip_damaged(place, record.content.size(),
                 "message of a channel that the file does not declare");
    return std::nullopt;
  }
  const bool in_time = message.logged_ns >= chunk_start_ns_ && message.logged_ns <= chunk_end_ns_;
  if (in_chunk_ && chunk_cut_ && !in_time) {
    ++counters_.implausible;
    skip_damaged(place, record.content.size(),
                 "message of a cut chunk at a time that is none of its");
    return std::nullopt;
  }
  message_place_ = place;
  ++counters_.messages;
  if (!verified) ++counters_.unverified;
  return message;
}

// False: the inside of the record contradicts its length.
bool McapReader::read(const Record& record) {
  switch (record.opcode) {
    case McapOpcode::kSchema:
      return read_schema(record);
    case McapOpcode::kChannel:
      return read_channel(record);
    case McapOpcode::kChunk:
      return open_chunk(record);
    case McapOpcode::kMetadata:
      return read_metadata(record);
    case McapOpcode::kDataEnd:
      return read_data_end(record);
    case McapOpcode::kFooter:
      return read_footer(record);
    default:
      ++counters_.other_records;
      return record.opcode != McapOpcode{};  // 0 is no opcode: a tail of zeros
  }
}

bool McapReader::read_schema(const Record& record) {
  McapCursor in{record.content};
  const std::uint16_t id = in.u16();
  Schema schema;
  schema.name = in.string();
  schema.encoding = in.string();
  schema.text = in.string();
  if (!in.ok() || id == 0) return false;
  schemas_.try_emplace(id, std::move(schema));
  return true;
}

bool McapReader::read_channel(const Record& record) {
  McapCursor in{record.content};
  const std::uint16_t id = in.u16();
  const std::uint16_t schema = in.u16();
  Channel channel;
  channel.topic = in.string();
  channel.message_encoding = in.string();
  channel.metadata = read_pairs(in);
  const auto known = schemas_.find(schema);
  if (!in.ok() || (schema != 0 && known == schemas_.end())) return false;
  if (schema != 0) channel.schema = known->second;
  channels_.try_emplace(id, std::move(channel));
  return true;
}

bool McapReader::read_metadata(const Record& record) {
  McapCursor in{record.content};
  const std::string_view name = in.string();
  Metadata pairs = read_pairs(in);
  if (in.ok() && name == "run") run_ = std::move(pairs);
  return in.ok();
}

bool McapReader::read_data_end(const Record& record) {
  McapCursor in{record.content};
  const std::uint32_t crc = in.u32();
  const auto begin = static_cast<std::size_t>(place_of(record.content) - kMcapRecordHeaderBytes);
  if (crc != 0 && crc != bits::crc32_ieee(file_.first(begin))) ++counters_.bad_data_crc;
  return in.ok();
}

bool McapReader::read_footer(const Record& record) {
  McapCursor in{record.content};
  const std::uint64_t summary_start = in.u64();
  in.u64();  // where the summary offsets start
  const std::uint64_t crc_place = place_of(in.rest());
  const std::uint32_t crc = in.u32();
  if (!in.ok() || summary_start > crc_place) return false;
  const auto begin = static_cast<std::size_t>(summary_start);
  const auto covered = file_.subspan(begin, static_cast<std::size_t>(crc_place) - begin);
  if (crc != 0 && summary_start != 0 && crc != bits::crc32_ieee(covered))
    ++counters_.bad_summary_crc;

  const bool cut = rest_.size() < kMcapMagic.size();
  const bool whole = std::ranges::equal(rest_, kMcapMagic);
  stop(whole ? McapEnd::kComplete
       : cut ? McapEnd::kTruncated
             : McapEnd::kMalformed,
       whole ? file_.size() : place_of(rest_));
  return true;
}

bool McapReader::open_chunk(const Record& record) {
  McapCursor in{record.content};
  chunk_place_ = place_of(record.content) - kMcapRecordHeaderBytes;
  chunk_start_ns_ = in.u64();
  chunk_end_ns_ = in.u64();
  const std::uint64_t plain_bytes = in.u64();
  const std::uint32_t crc = in.u32();
  const std::string_view compression = in.string();
  const std::uint64_t bytes = in.u64();
  if (!in.ok()) return false;
  ++counters_.chunks;
  chunk_ = in.rest();
  chunk_cut_ = record.cut;
  if (!record.cut && bytes != chunk_.size()) return false;
  chunk_compressed_ = !compression.empty();
  if (chunk_compressed_) {
    if (record.cut) return false;
    if (!decompress_chunk(record, compression, plain_bytes)) return true;
  } else if (plain_bytes != bytes) {
    return false;
  }
  chunk_verified_ = !record.cut && crc != 0;
  in_chunk_ = !chunk_verified_ || crc == bits::crc32_ieee(chunk_);
  if (in_chunk_) return true;
  ++counters_.bad_chunk_crc;
  skip_damaged(chunk_place_, record.content.size(), "chunk whose checksum is wrong");
  return true;
}

bool McapReader::decompress_chunk(const Record& record, std::string_view compression,
                                  std::uint64_t plain_bytes) {
  const auto plain = decompress_ ? decompress_(compression, chunk_, plain_bytes)
                                 : Result<std::span<const std::uint8_t>, std::string>{
                                       Unexpected{"compressed chunk: " + std::string{compression}}};
  if (plain) {
    chunk_ = *plain;
    return true;
  }
  ++counters_.compressed_chunks;
  skip_damaged(chunk_place_, record.content.size(), plain.error());
  return false;
}

const char* to_string(McapEnd end) {
  switch (end) {
    case McapEnd::kReading:
      return "reading";
    case McapEnd::kComplete:
      return "complete";
    case McapEnd::kNoMagic:
      return "not an MCAP file";
    case McapEnd::kTruncated:
      return "truncated";
    case McapEnd::kMalformed:
      return "malformed";
  }
  return "?";
}

}  // namespace pitwall::recording

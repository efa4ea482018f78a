// SPDX-License-Identifier: Apache-2.0
#include "hil/replay/recordings/mcap_recording.hpp"

#include <algorithm>
#include <limits>
#include <map>

#include "hil/replay/recordings/decompression.hpp"
#include "hil/replay/recordings/receiver_stream.hpp"
#include "hil/replay/recordings/recording_builder.hpp"
#include "hil/replay/recordings/ros_message.hpp"
#include "protocol/recorder/can_record.hpp"
#include "protocol/recorder/raw_record.hpp"
#include "protocol/recording/mcap_reader.hpp"

namespace pitwall::traffic {
namespace {

using recording::McapMessage;
using recording::McapReader;

constexpr std::string_view kOwnCanSchema = "pitwall_msgs/msg/CarCanFrame";

enum class Content : std::uint8_t { kOwnCan, kRosCan, kReceiver, kRos, kOther };

struct Topic {
  Content content = Content::kOther;
  std::string type;
  std::uint32_t source = 0;
};

Content content_of(const recording::Channel& channel) {
  if (channel.message_encoding == recorder::kStreamEncoding) return Content::kReceiver;
  if (channel.message_encoding != "cdr") return Content::kOther;
  if (channel.schema.name == kOwnCanSchema) return Content::kOwnCan;
  return is_ros_can(channel.schema.name) ? Content::kRosCan : Content::kRos;
}

SourceKind kind_of(Content content) {
  switch (content) {
    case Content::kOwnCan:
    case Content::kRosCan:
      return SourceKind::kCan;
    case Content::kReceiver:
      return SourceKind::kReceiver;
    case Content::kRos:
      return SourceKind::kRos;
    case Content::kOther:
      break;
  }
  return SourceKind::kOther;
}

UtcTime stamp_of(const McapMessage& message) {
  constexpr auto kMost = static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max());
  return {static_cast<std::int64_t>(std::min(message.logged_ns, kMost))};
}

class McapImport {
 public:
  McapImport(const transport::FileBytes& file, const std::string& name,
             const replay::ReadProgress& reached)
      : builder_(name, reached, file.bytes().size()),
        file_(builder_.pool().adopt(file)),
        reader_(file_, [this](std::string_view compression, Bytes bytes, std::uint64_t plain) {
          return decompressed(compression, bytes, plain);
        }) {}
  McapImport(const McapImport&) = delete;  // the reader's decompressor knows where it lies
  McapImport& operator=(const McapImport&) = delete;

  bool is_mcap() const { return reader_.end() != recording::McapEnd::kNoMagic; }

  Recording run() && {
    while (const auto message = reader_.next()) take(*message);
    declare_channels();
    name_receivers();
    remark_end();
    return std::move(builder_).finish();
  }

 private:
  Result<Bytes, std::string> decompressed(std::string_view compression, Bytes bytes,
                                          std::uint64_t plain_bytes) {
    auto plain = decompress_chunk(compression, bytes, plain_bytes);
    if (!plain) return Unexpected{plain.error()};
    return builder_.pool().adopt(*std::move(plain));
  }

  // All that are known so far, in the order of their ids: so sources do not depend on which speaks
  // first.
  void declare_channels() {
    for (const auto& [id, channel] : reader_.channels()) {
      if (topics_.contains(id)) continue;
      Topic topic{.content = content_of(channel), .type = channel.schema.name};
      const SourceKind kind = kind_of(topic.content);
      std::string type = kind == SourceKind::kCan   ? "can"
                         : kind == SourceKind::kRos ? topic.type
                                                    : channel.message_encoding;
      topic.source = builder_.add_source(channel.topic, kind, std::move(type));
      topics_.emplace(id, std::move(topic));
    }
  }

  void take(const McapMessage& message) {
    auto topic = topics_.find(message.channel);
    if (topic == topics_.end()) {
      declare_channels();
      topic = topics_.find(message.channel);
    }
    const Topic& to = topic->second;
    const UtcTime at = stamp_of(message);
    switch (to.content) {
      case Content::kOwnCan:
        return take_own_can(to, at, message.data);
      case Content::kRosCan:
        return take_ros_can(to, at, message.data);
      case Content::kRos:
        if (const auto fault = fault_of(to.type, message.data)) {
          return builder_.refuse(place(), *fault);
        }
        break;
      case Content::kReceiver:
      case Content::kOther:
        break;
    }
    builder_.add(to.source, at, message.data, place());
  }

  void take_own_can(const Topic& to, UtcTime at, Bytes cdr) {
    const auto frame = recorder::decode_frame(cdr);
    if (!frame) return builder_.refuse(place(), frame.error());
    builder_.add(to.source, at, *frame, place());
  }

  void take_ros_can(const Topic& to, UtcTime at, Bytes cdr) {
    const auto message = read_ros_can(to.type, cdr);
    if (!message) return builder_.refuse(place(), message.error());
    if (message->is_error) {
      ++builder_.counters().error_frames;
    } else {
      builder_.add(to.source, at, message->frame, place());
    }
  }

  // Which receiver it is, its bytes say.
  void name_receivers() {
    for (std::uint32_t i = 0; i < builder_.sources().size(); ++i) {
      Source& source = builder_.sources()[i];
      if (source.kind != SourceKind::kReceiver) continue;
      source.type = to_string(receiver_of(as_bytes(builder_.first_bytes(i, kReceiverProbeBytes))));
    }
  }

  void remark_end() {
    const recording::McapReaderCounters& read = reader_.counters();
    RecordingCounters& counters = builder_.counters();
    for (const recording::McapGap& gap : reader_.gaps()) {
      builder_.remark(gap.place, gap.what + ": left out, " + std::to_string(gap.bytes) + " bytes");
      counters.lost_bytes += gap.bytes;
    }
    counters.unverified = read.unverified;
    counters.lost_blocks = read.bad_chunk_crc + read.compressed_chunks + read.broken_chunks;
    counters.refused += read.unknown_channel + read.implausible;
    if (read.unverified > 0) builder_.remark(0, "messages without a checksum", read.unverified);
    if (read.bad_data_crc > 0) builder_.remark(0, "checksum of all data is wrong");
    if (read.bad_summary_crc > 0)
      builder_.remark(reader_.place(), "checksum of the index is wrong");
    if (reader_.end() == recording::McapEnd::kComplete) return;
    counters.lost_bytes += file_.size() - reader_.place();
    builder_.remark(reader_.place(), std::string{"file is "} + to_string(reader_.end()) +
                                         " here: nothing is read behind it");
  }

  std::uint64_t place() const { return reader_.message_place(); }

  RecordingBuilder builder_;
  Bytes file_;
  McapReader reader_;
  std::map<std::uint16_t, Topic> topics_;
};

}  // namespace

Result<Recording, Problem> read_mcap(const transport::FileBytes& file, const std::string& name,
                                     const replay::ReadProgress& reached) {
  McapImport import{file, name, reached};
  if (!import.is_mcap()) return refuse(name + ": byte 0", "not an MCAP file: no magic number");
  return std::move(import).run();
}

}  // namespace pitwall::traffic

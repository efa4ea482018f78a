// SPDX-License-Identifier: Apache-2.0
#include "hil/replay/recordings/sqlite_bag.hpp"

#include <algorithm>
#include <limits>
#include <map>

#include "hil/replay/recordings/decompression.hpp"
#include "hil/replay/recordings/recording_builder.hpp"
#include "hil/replay/recordings/ros_message.hpp"
#include "hil/replay/recordings/sqlite_image.hpp"

namespace pitwall::traffic {
namespace {

constexpr std::int64_t kLastId = std::numeric_limits<std::int64_t>::max();
constexpr std::int64_t kMostSkipped = std::int64_t{1} << 40;  // more messages than any bag has

struct BagTopic {
  std::string type;
  std::uint32_t source = 0;
  bool is_can = false, is_cdr = false;
};

class BagImport {
 public:
  BagImport(SqliteImage& image, RecordingBuilder& builder) : image_(image), builder_(builder) {}

  // False: there is no such table.
  bool read_topics() {
    auto rows = image_.query("SELECT id, name, type, serialization_format FROM topics ORDER BY id");
    if (!rows) return false;
    while (rows->next()) {
      const auto id = rows->integer(0);
      if (!id || topics_.contains(*id)) {
        builder_.remark_at("table topics", "topic without an id of its own: left out");
        continue;
      }
      add_topic(*id, rows->text(1), rows->text(2), rows->text(3));
    }
    if (rows->failed()) builder_.remark_at("table topics", "cannot be read to its end");
    return true;
  }

  bool read_messages() {
    if (!image_.query(kMessagesFrom)) return false;
    std::int64_t from = std::numeric_limits<std::int64_t>::min();
    while (!read_from(from)) {
      const std::int64_t next = readable_behind(last_id_);
      ++builder_.counters().lost_blocks;
      const bool any = next - last_id_ < kMostSkipped;
      builder_.remark_at(where(last_id_) + " to " + (any ? where(next) : "the last"),
                         "messages between cannot be read: " + image_.fault());
      // A tree in which a search leads astray gives the same message again and again.
      if (next <= from) break;
      from = next;
    }
    return true;
  }

 private:
  static constexpr const char* kMessagesFrom =
      "SELECT id, topic_id, timestamp, data FROM messages WHERE id >= ? ORDER BY id";

  void add_topic(std::int64_t id, std::string name, std::string type, const std::string& format) {
    BagTopic topic;
    topic.is_cdr = format == "cdr";
    topic.is_can = topic.is_cdr && is_ros_can(type);
    topic.type = type;
    const SourceKind kind = topic.is_can   ? SourceKind::kCan
                            : topic.is_cdr ? SourceKind::kRos
                                           : SourceKind::kOther;
    topic.source = builder_.add_source(std::move(name), kind,
                                       topic.is_can   ? "can"
                                       : topic.is_cdr ? type
                                                      : format);
    topics_.emplace(id, std::move(topic));
  }

  // True: there are no more messages. False: what follows last_id_ cannot be read.
  bool read_from(std::int64_t from) {
    auto rows = image_.query(kMessagesFrom);
    rows->bind(from);
    while (rows->next()) {
      const auto id = rows->integer(0);
      if (!id || *id < from) return false;  // a page that stands in the tree twice
      last_id_ = *id;
      if (*id == kLastId) return true;
      from = *id + 1;
      take(*rows, *id);
    }
    return !rows->failed();
  }

  // The first id behind a message from which on messages can be read, or there are none.
  std::int64_t readable_behind(std::int64_t last) {
    const auto readable = [this](std::int64_t id) {
      auto rows = image_.query(kMessagesFrom);
      rows->bind(id);
      return rows->next() || !rows->failed();
    };
    if (last > kLastId - 2 * kMostSkipped) return kLastId;
    std::int64_t good = 1;  // steps behind the last message
    while (good < kMostSkipped && !readable(last + good)) good *= 2;
    std::int64_t bad = good / 2;
    while (good - bad > 1) {
      const std::int64_t middle = bad + (good - bad) / 2;
      (readable(last + middle) ? good : bad) = middle;
    }
    return last + good;
  }

  static std::string where(std::int64_t id) { return "message " + std::to_string(id); }

  void refuse_message(std::int64_t id, std::string_view what) {
    ++builder_.counters().refused;
    builder_.remark_at(where(id), what);
  }

  void take(const SqliteRows& rows, std::int64_t id) {
    const auto topic_id = rows.integer(1), stamp = rows.integer(2);
    const auto blob = rows.blob(3);
    if (!topic_id || !stamp || !blob)
      return refuse_message(id, "message without topic, stamp or data");
    const auto topic = topics_.find(*topic_id);
    if (topic == topics_.end())
      return refuse_message(id, "message of a topic that is not declared");
    if (*stamp < 0 || UtcTime{*stamp} > kLatestStamp)
      return refuse_message(id, "message with an impossible stamp: not from 1970 to 2191");
    if (!is_zstd(*blob)) return put(topic->second, id, {*stamp}, builder_.pool().copy(*blob));
    auto plain = decompress_zstd(*blob);
    if (!plain) return refuse_message(id, plain.error());
    put(topic->second, id, {*stamp}, builder_.pool().adopt(*std::move(plain)));
  }

  void put(const BagTopic& topic, std::int64_t id, UtcTime at, Bytes data) {
    const auto number = static_cast<std::uint64_t>(id);
    if (topic.is_can) {
      const auto message = read_ros_can(topic.type, data);
      if (!message) return refuse_message(id, message.error());
      if (message->is_error) {
        ++builder_.counters().error_frames;
      } else {
        builder_.add(topic.source, at, message->frame, number);
      }
      return;
    }
    const auto fault = topic.is_cdr ? fault_of(topic.type, data) : std::nullopt;
    if (fault) return refuse_message(id, *fault);
    ++builder_.counters().unverified;
    builder_.add(topic.source, at, data, number);
  }

  SqliteImage& image_;
  RecordingBuilder& builder_;
  std::map<std::int64_t, BagTopic> topics_;
  std::int64_t last_id_ = 0;
};

}  // namespace

bool is_sqlite(Bytes file) { return SqliteImage::is_one(file); }

Result<Recording, Problem> read_sqlite_bag(transport::FileBytes file, const std::string& name) {
  if (!SqliteImage::is_one(file.bytes())) return refuse(name + ": byte 0", "not a SQLite file");
  RecordingBuilder builder{name};
  const std::size_t size = file.bytes().size();
  const bool has_log = SqliteImage::had_write_ahead_log(file.bytes());
  const auto announced = SqliteImage::announced_bytes(file.bytes());
  if (announced > size) {
    builder.counters().lost_bytes += announced - size;
    builder.remark(size, "file is cut here: it had " + std::to_string(announced) + " bytes");
  } else if (announced != 0 && announced < size) {
    builder.remark(announced, "more bytes than the file says that it has: " +
                                  std::to_string(size - announced));
  }
  SqliteImage image{std::move(file)};
  BagImport import{image, builder};
  if (!import.read_topics() || !import.read_messages())
    return refuse(
        name + ": byte 0",
        "not a bag of ROS 2: expected the tables topics and messages (" + image.fault() + ")");
  if (has_log) {
    builder.remark(0, "was written with a write-ahead log: where " + name +
                          "-wal exists, its messages are not read; put them in with: sqlite3 " +
                          name + " 'PRAGMA wal_checkpoint(TRUNCATE)'");
  }
  return std::move(builder).finish();
}

}  // namespace pitwall::traffic

// Channels of a recording of base or car, and the encoding of their samples.
//   channels  /car/GROUP for each group of the registry, "cdr" with a ROS 2 schema: every field a
//             float64, NaN if unknown; log time is the reception, publish time the sample
//             /base/TYPE, "json": exactly the texts that consoles get
//             /base/picture, "cdr": all values known at a moment, so that a reader can begin there
//             /radio/down, /radio/up, /gnss/0, /gnss/1: raw bytes as received and sent, see
//             raw_record.hpp
//             /can/in, /can/out: frames of the car's bus, "cdr", see can_record.hpp
//             /car/tick: the other inputs of a tick of the car, "cdr", see tick_record.hpp
//   clock     stamps in the file are UTC: an Instant of the base plus the ClockMap of the file,
//             which is in its metadata, so that an Instant is restored exactly
//   invariants
//             fields are matched by their names, which each channel carries: a file of another
//             version of the registry gives the fields that both versions have
//   errors    decode() returns false for bytes that are not a sample of the channel
//   cost      no allocation in encode() of a group and decode()
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/recording/mcap_writer.hpp"
#include "protocol/telemetry/registry/registry.hpp"
#include "protocol/vocabulary/fixed_vector.hpp"

namespace pitwall::recorder {

// JSON texts, by their "type" in the messages to a console.
enum class Topic : std::uint8_t {
  kHello,
  kCommand,
  kAlarms,
  kAlarmEvent,
  kAuthority,
  kAudit,
  kEvent,
  kLink,
  kNotice,
  kFuel,
  kMark,
  kJoystick,
  kRecorder,
  kJudge,  // configuration of the alarm evaluator
  kInput,  // its inputs that are not vehicle state
  kExpected,
  kSettings
};
inline constexpr std::array<std::string_view, 17> kTopicNames{
    "hello",    "command", "alarms", "alarm_event", "authority", "audit",
    "event",    "link",    "notice", "fuel",        "mark",      "joystick",
    "recorder", "judge",   "input",  "expected",    "settings"};
inline constexpr std::size_t kTopics = kTopicNames.size();
constexpr std::string_view name_of(Topic topic) {
  return kTopicNames[static_cast<std::size_t>(topic)];
}
std::optional<Topic> topic_named(std::string_view type);

// Indices of the channels in the list of channels().
constexpr std::uint16_t channel_of(telemetry::Group group) {
  return static_cast<std::uint16_t>(telemetry::index_of(group));
}
constexpr std::uint16_t channel_of(Topic topic) {
  return static_cast<std::uint16_t>(telemetry::kGroups + static_cast<std::size_t>(topic));
}
constexpr bool is_group(std::uint16_t channel) { return channel < telemetry::kGroups; }
inline constexpr auto kSnapshotChannel = static_cast<std::uint16_t>(telemetry::kGroups + kTopics);
inline constexpr std::uint16_t kDownChannel = kSnapshotChannel + 1, kUpChannel = kDownChannel + 1;
inline constexpr std::uint16_t kCanInChannel = kUpChannel + 1, kCanOutChannel = kCanInChannel + 1;
// Of unit 0; that of unit 1 follows.
inline constexpr std::uint16_t kReceiverChannel = kCanOutChannel + 1;
inline constexpr std::size_t kReceivers = 2;
inline constexpr std::uint16_t kTickChannel = kReceiverChannel + kReceivers;
std::vector<recording::Channel> channels();

struct ClockMap {
  Duration utc_minus_base{};
  std::string boot{};  // boot id of the machine: two files of one boot share the base's clock

  Instant to_file(Instant base) const { return base + utc_minus_base; }
  Instant to_base(Instant file) const { return file - utc_minus_base; }
};
void append(recording::Metadata& run, const ClockMap& clock);
// Empty if the file is not from our recorder.
std::optional<ClockMap> clock_of(const recording::Metadata& run);

inline constexpr std::size_t kCdrHeader = 4;
inline constexpr std::size_t kLargestGroup = [] {
  std::size_t largest = 0;
  for (const auto& span : telemetry::kGroupFields) largest = std::max(largest, span.count);
  return largest;
}();
using GroupBytes = FixedVector<std::uint8_t, kCdrHeader + kLargestGroup * sizeof(double)>;
GroupBytes encode(telemetry::Group group, const telemetry::Values& values);

// The newest known value of each field, and its sample time.
struct Known {
  telemetry::Values value;
  std::array<Instant, telemetry::kFieldCount> sampled = [] {
    std::array<Instant, telemetry::kFieldCount> never{};
    never.fill(telemetry::kNeverSampled);
    return never;
  }();

  void take(telemetry::Group group, std::span<const std::uint8_t> sample, Instant sampled_at);
};
// With the sample times of the file.
std::vector<std::uint8_t> encode(const Known& known);

// Mapping of the fields of a channel, possibly of another version, to our field indices.
class ChannelFields {
 public:
  static std::optional<ChannelFields> of(const recording::Channel& channel);

  bool is_snapshot() const { return snapshot_; }
  // Writes all fields of one group into the values; leaves the others unchanged. False if the bytes
  // are not a sample of this channel.
  bool decode(std::span<const std::uint8_t> sample, telemetry::Values& values) const;
  bool decode(std::span<const std::uint8_t> sample, Known& known) const;
  // Group of the known fields; empty if no field of the channel is known here.
  std::optional<telemetry::Group> group() const { return group_; }

 private:
  std::vector<std::optional<telemetry::FieldIndex>> places_;
  std::optional<telemetry::Group> group_;
  bool snapshot_ = false;
};

}  // namespace pitwall::recorder

// Channels of a recording of base or car, and the bytes of a sample.
//   channels  /car/GROUP for each group of the registry, "cdr" with a ROS 2 schema: every field a
//             float64, NaN where it was not known; log time is the reception, publish time the
//             sample
//             /base/TYPE, "json": the very text that consoles get
//             /base/picture, "cdr": all that was known at a moment: a reader can begin there
//             /radio/down, /radio/up, /gnss/0, /gnss/1: bytes as they came and went, as
//             raw_record.hpp has them
//             /can/in, /can/out: frames of the car's bus, "cdr", as can_record.hpp has them
//             /car/tick: what else a tick of the car was given, "cdr", as tick_record.hpp has it
//   clock     stamps in the file are UTC: an Instant of the base plus the ClockMap of the file,
//             which stands in its metadata, so that an Instant comes back exactly
//   invariants
//             fields are found by their names, which each channel carries: a file of another
//             version of the registry gives the fields that both have
//   errors    bytes that are no sample of their channel give nothing
//   cost      no allocation in encode() and decode()
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
#include "protocol/telemetry/registry/snapshot.hpp"
#include "protocol/vocabulary/fixed_vector.hpp"

namespace pitwall::recorder {

// JSON texts, by the "type" that they have on the wire to a console.
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
  kJudge,  // what judges, and
  kInput,  // what it is told beside states
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

// Places of the channels in the list that channels() gives.
constexpr std::uint16_t channel_of(telemetry::Group group) {
  return static_cast<std::uint16_t>(telemetry::index_of(group));
}
constexpr std::uint16_t channel_of(Topic topic) {
  return static_cast<std::uint16_t>(telemetry::kGroups + static_cast<std::size_t>(topic));
}
constexpr bool is_group(std::uint16_t channel) { return channel < telemetry::kGroups; }
inline constexpr auto kPictureChannel = static_cast<std::uint16_t>(telemetry::kGroups + kTopics);
inline constexpr std::uint16_t kDownChannel = kPictureChannel + 1, kUpChannel = kDownChannel + 1;
inline constexpr std::uint16_t kCanInChannel = kUpChannel + 1, kCanOutChannel = kCanInChannel + 1;
inline constexpr std::uint16_t kReceiverChannel = kCanOutChannel + 1;  // of unit 0; 1 is the next
inline constexpr std::size_t kReceivers = 2;
inline constexpr std::uint16_t kTickChannel = kReceiverChannel + kReceivers;
std::vector<recording::Channel> channels();

struct ClockMap {
  Duration utc_minus_base{};
  std::string boot{};  // of the machine: two files of one boot share the base's clock

  Instant to_file(Instant base) const { return base + utc_minus_base; }
  Instant to_base(Instant file) const { return file - utc_minus_base; }
};
void append(recording::Metadata& run, const ClockMap& clock);
std::optional<ClockMap> clock_of(const recording::Metadata& run);  // none: no file of ours

inline constexpr std::size_t kCdrHeader = 4;
inline constexpr std::size_t kLargestGroup = [] {
  std::size_t largest = 0;
  for (const auto& span : telemetry::kGroupFields) largest = std::max(largest, span.count);
  return largest;
}();
using GroupBytes = FixedVector<std::uint8_t, kCdrHeader + kLargestGroup * sizeof(double)>;
GroupBytes encode(telemetry::Group group, const telemetry::Values& values);

// The newest known value of each field, and when it was sampled.
struct Known {
  telemetry::Values value;
  std::array<Instant, telemetry::kFieldCount> sampled = [] {
    std::array<Instant, telemetry::kFieldCount> never{};
    never.fill(telemetry::kNeverSampled);
    return never;
  }();

  void take(telemetry::Group group, std::span<const std::uint8_t> sample, Instant sampled_at);
};
// Sample times as they are in the file.
std::vector<std::uint8_t> encode(const Known& known);

// Of a file that may have been written by another version: the fields of a channel by our places.
class ChannelFields {
 public:
  static std::optional<ChannelFields> of(const recording::Channel& channel);

  bool is_picture() const { return picture_; }
  // All fields of one group, in the values; others are left as they are. False: no such bytes.
  bool decode(std::span<const std::uint8_t> sample, telemetry::Values& values) const;
  bool decode(std::span<const std::uint8_t> sample, Known& known) const;
  // Where every field of the channel has gone: nothing of it is known here.
  std::optional<telemetry::Group> group() const { return group_; }

 private:
  std::vector<std::optional<telemetry::FieldIndex>> places_;
  std::optional<telemetry::Group> group_;
  bool picture_ = false;
};

}  // namespace pitwall::recorder

// SPDX-License-Identifier: Apache-2.0
#include "protocol/recorder/channels.hpp"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>

#include "protocol/recorder/can_record.hpp"
#include "protocol/recorder/raw_record.hpp"
#include "protocol/recorder/tick_record.hpp"
#include "protocol/vocabulary/bytes.hpp"
#include "protocol/vocabulary/check.hpp"

namespace pitwall::recorder {
namespace {

using telemetry::FieldIndex;
using telemetry::FieldRow;
using telemetry::kFieldCount;

constexpr std::array<std::uint8_t, kCdrHeader> kLittleEndianCdr{0, 1, 0, 0};
constexpr std::string_view kFieldsKey = "fields", kClockKey = "utc_minus_base_ns",
                           kBootKey = "boot", kSnapshotTopic = "/base/picture";
constexpr std::string_view kAnyObject = R"({"type":"object"})";

std::string path_of(const FieldRow& row) {
  return std::string{telemetry::row_of(row.group).name} + "." + std::string{row.name};
}

// Where the number of this index begins.
std::size_t place_of(std::size_t index) { return kCdrHeader + index * sizeof(std::uint64_t); }

std::uint64_t get(std::span<const std::uint8_t> sample, std::size_t index) {
  return load<std::uint64_t>(sample, place_of(index));
}

bool is_cdr(std::span<const std::uint8_t> sample, std::size_t numbers) {
  return sample.size() == kCdrHeader + numbers * sizeof(double) &&
         std::ranges::equal(sample.first(kCdrHeader), kLittleEndianCdr);
}

recording::Channel group_channel(const telemetry::GroupRow& row) {
  std::string schema, fields;
  const auto [first, count] = telemetry::fields_of(row.group);
  for (FieldIndex i = first; i < first + count; ++i) {
    const FieldRow& field = telemetry::kFields[i];
    schema += "float64 " + std::string{field.name};
    schema += field.unit.empty() ? "\n" : "  # " + std::string{field.unit} + "\n";
    fields += (fields.empty() ? "" : ",") + path_of(field);
  }
  const std::string name{row.name};
  return {"/car/" + name,
          "cdr",
          {"pitwall_msgs/msg/" + name, "ros2msg", schema},
          {{std::string{kFieldsKey}, fields}}};
}

recording::Channel snapshot_channel() {
  const std::string count = std::to_string(kFieldCount);
  std::string fields;
  for (const FieldRow& row : telemetry::kFields)
    fields += (fields.empty() ? "" : ",") + path_of(row);
  return {std::string{kSnapshotTopic},
          "cdr",
          {"pitwall_msgs/msg/Picture", "ros2msg",
           "float64[" + count + "] value\nint64[" + count + "] sampled_ns\n"},
          {{std::string{kFieldsKey}, fields}}};
}

std::optional<FieldIndex> field_named(std::string_view path) {
  for (FieldIndex i = 0; i < kFieldCount; ++i) {
    if (path_of(telemetry::kFields[i]) == path) return i;
  }
  return std::nullopt;
}

const std::string* find(const recording::Metadata& pairs, std::string_view key) {
  const auto found = std::ranges::find(pairs, key, [](const auto& pair) { return pair.first; });
  return found == pairs.end() ? nullptr : &found->second;
}

}  // namespace

std::optional<Topic> topic_named(std::string_view type) {
  const auto found = std::ranges::find(kTopicNames, type);
  if (found == kTopicNames.end()) return std::nullopt;
  return static_cast<Topic>(found - kTopicNames.begin());
}

std::vector<recording::Channel> channels() {
  std::vector<recording::Channel> all;
  for (const telemetry::GroupRow& row : telemetry::kGroupTable) all.push_back(group_channel(row));
  for (const std::string_view name : kTopicNames) {
    all.push_back({"/base/" + std::string{name},
                   "json",
                   {"pitwall_msgs/msg/" + std::string{name}, "jsonschema", std::string{kAnyObject}},
                   {}});
  }
  all.push_back(snapshot_channel());
  for (const char* topic : {"/radio/down", "/radio/up"}) {
    all.push_back(
        {topic, kDatagramEncoding, {}, {{"layout", "version, path, port, address, data"}}});
  }
  for (const char* topic : {kReceivedTopic, kSentTopic}) {
    all.push_back(recording::cdr_channel<CanRecord>(topic));
  }
  for (const char* topic : {"/gnss/0", "/gnss/1"}) all.push_back({topic, kStreamEncoding, {}, {}});
  all.push_back(recording::cdr_channel<TickRecord>(kTickTopic));
  CHECK(all.size() == kTickChannel + 1);
  return all;
}

void append(recording::Metadata& run, const ClockMap& clock) {
  run.emplace_back(kClockKey, std::to_string(clock.utc_minus_base.ns));
  run.emplace_back(kBootKey, clock.boot);
}

std::optional<ClockMap> clock_of(const recording::Metadata& run) {
  const std::string* const offset = find(run, kClockKey);
  const std::string* const boot = find(run, kBootKey);
  if (offset == nullptr || boot == nullptr) return std::nullopt;
  ClockMap clock{.boot = *boot};
  const char* const end = offset->data() + offset->size();
  const auto [stop, error] = std::from_chars(offset->data(), end, clock.utc_minus_base.ns);
  if (error != std::errc{} || stop != end) return std::nullopt;
  return clock;
}

GroupBytes encode(telemetry::Group group, const telemetry::Values& values) {
  GroupBytes bytes;
  for (const std::uint8_t byte : kLittleEndianCdr) CHECK(bytes.push(byte));
  const auto [first, count] = telemetry::fields_of(group);
  for (FieldIndex i = first; i < first + count; ++i) {
    std::array<std::uint8_t, sizeof(double)> number{};
    store(number, std::bit_cast<std::uint64_t>(values[i]));
    for (const std::uint8_t byte : number) CHECK(bytes.push(byte));
  }
  return bytes;
}

void Known::take(telemetry::Group group, std::span<const std::uint8_t> sample, Instant sampled_at) {
  const auto [first, count] = telemetry::fields_of(group);
  if (!is_cdr(sample, count)) return;
  for (std::size_t i = 0; i < count; ++i) {
    const auto number = std::bit_cast<double>(get(sample, i));
    if (std::isnan(number)) continue;  // not known now: the last known one stays
    value[first + i] = number;
    sampled[first + i] = sampled_at;
  }
}

std::vector<std::uint8_t> encode(const Known& known) {
  std::vector<std::uint8_t> bytes(kCdrHeader + 2 * kFieldCount * sizeof(double));
  std::ranges::copy(kLittleEndianCdr, bytes.begin());
  for (FieldIndex i = 0; i < kFieldCount; ++i) {
    store(bytes, place_of(i), std::bit_cast<std::uint64_t>(known.value[i]));
    store(bytes, place_of(kFieldCount + i), static_cast<std::uint64_t>(known.sampled[i].ns));
  }
  return bytes;
}

std::optional<ChannelFields> ChannelFields::of(const recording::Channel& channel) {
  const std::string* const names = find(channel.metadata, kFieldsKey);
  if (names == nullptr) return std::nullopt;
  ChannelFields fields;
  fields.snapshot_ = channel.topic == kSnapshotTopic;
  std::string_view rest{*names};
  while (!rest.empty()) {
    const std::string_view name = rest.substr(0, rest.find(','));
    rest.remove_prefix(std::min(rest.size(), name.size() + 1));
    fields.places_.push_back(field_named(name));
    if (fields.places_.back()) fields.group_ = telemetry::kFields[*fields.places_.back()].group;
  }
  return fields;
}

bool ChannelFields::decode(std::span<const std::uint8_t> sample, telemetry::Values& values) const {
  if (snapshot_ || !is_cdr(sample, places_.size())) return false;
  for (std::size_t i = 0; i < places_.size(); ++i) {
    if (places_[i]) values[*places_[i]] = std::bit_cast<double>(get(sample, i));
  }
  return true;
}

bool ChannelFields::decode(std::span<const std::uint8_t> sample, Known& known) const {
  if (!snapshot_ || !is_cdr(sample, 2 * places_.size())) return false;
  for (std::size_t i = 0; i < places_.size(); ++i) {
    if (!places_[i]) continue;
    known.value[*places_[i]] = std::bit_cast<double>(get(sample, i));
    known.sampled[*places_[i]] = {static_cast<std::int64_t>(get(sample, places_.size() + i))};
  }
  return true;
}

}  // namespace pitwall::recorder

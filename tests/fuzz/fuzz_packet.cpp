// SPDX-License-Identifier: Apache-2.0
// Any bytes are refused or are the one form of what they say: written again they are the same, and
// a second, slow reader agrees. Half of the inputs are contents that a sender writes and a few
// bytes that are then changed, so that whole packets are reached too.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "protocol/telemetry/packet/body.hpp"
#include "protocol/vocabulary/check.hpp"
#include "tests/support/reencode_body.hpp"
#include "tests/support/reference_body.hpp"

namespace {

using namespace pitwall;
using namespace pitwall::telemetry;
using Bytes = std::vector<std::uint8_t>;

// The fuzzer's bytes as choices; zeros when they are used up.
class Choices {
 public:
  explicit Choices(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  bool empty() const { return bytes_.empty(); }
  std::uint32_t next(std::size_t size = 1) {
    std::uint32_t value = 0;
    for (; size > 0 && !bytes_.empty(); --size, bytes_ = bytes_.subspan(1)) {
      value = value << 8U | bytes_[0];
    }
    return value;
  }
  std::span<const std::uint8_t> take(std::size_t size) {
    const auto taken = bytes_.first(std::min(size, bytes_.size()));
    bytes_ = bytes_.subspan(taken.size());
    return taken;
  }

 private:
  std::span<const std::uint8_t> bytes_;
};

void compare(const Body& body, const testing::ReferenceBody& reference) {
  CHECK(body.tx_time_100us == reference.time && body.paths_mask == reference.paths);
  CHECK(body.ack.has_value() == reference.has_ack);
  if (body.ack) {
    CHECK(body.ack->newest_low == reference.newest && body.ack->mask == reference.mask);
    CHECK(body.ack->hold == microseconds(100) * static_cast<std::int64_t>(reference.hold));
  }
  CHECK(body.groups.count() == reference.ages.size());
  for (const auto& [group, age] : reference.ages) CHECK(body.age_codes[index_of(group)] == age);
  for (const auto& [field, value] : reference.values) {
    const double ours = body.values[field];
    CHECK(ours == value || (std::isnan(ours) && std::isnan(value)));
  }
  CHECK(body.records.size() == reference.records.size());
  for (std::size_t i = 0; i < body.records.size(); ++i) {
    const auto& [type, payload] = reference.records[i];
    CHECK(static_cast<std::uint64_t>(body.records[i].type) == type);
    CHECK(std::ranges::equal(body.records[i].payload, payload, {}, {},
                             [](char c) { return static_cast<std::uint8_t>(c); }));
  }
}

void read_both(const Bytes& bytes, Direction direction) {
  const auto body = parse_body(bytes, direction);
  const auto reference = testing::read_reference(bytes, direction);
  CHECK(body.has_value() == reference.has_value());
  if (!body) {
    CHECK(text_of(body.error())[0] != '\0');
    return;
  }
  compare(*body, *reference);
  CHECK(testing::reencode_body(*body, direction) == bytes);
}

// A receiver that does not know some of the sender's groups skips them: what it knows is the same.
void read_in_part(const Bytes& bytes, Direction direction, std::uint32_t unknown) {
  const auto whole = parse_body(bytes, direction);
  Layout layout = own_layout(direction);
  for (std::size_t k = 0; k < layout.size(); ++k) {
    if ((unknown >> (k % 32) & 1U) != 0) layout[k].own.reset();
  }
  const auto part = parse_body(bytes, layout);
  if (!whole) return;
  CHECK(part.has_value());
  for (const GroupPlace& place : layout) {
    if (place.own) CHECK(part->groups.has(*place.own) == whole->groups.has(*place.own));
  }
}

Bytes written(Choices& choices, Direction direction) {
  Bytes buffer(kMaxBody);
  const std::size_t room = kBodyFixed + choices.next(2) % (kMaxBody - kBodyFixed + 1);
  BodyWriter writer(buffer, room, direction);
  const Instant now{std::int64_t{choices.next(3)} * 100'000};
  writer.begin(now, static_cast<std::uint8_t>(choices.next() % (1U << kPaths)));
  if (choices.next() % 2 == 1) {
    const auto newest = static_cast<std::uint16_t>(choices.next(2));
    const std::uint32_t mask = choices.next(4);
    writer.add_ack({newest, mask, microseconds(choices.next(4))});
  }
  Snapshot snapshot;
  FixedVector<Group, kGroups> wanted;
  const std::uint32_t set = choices.next(4);
  for (const GroupPlace& place : own_layout(direction)) {
    const Group group = *place.own;
    if ((set >> (index_of(group) % 32) & 1U) == 0) continue;
    CHECK(wanted.push(group));
    snapshot.at(group) = now - microseconds(choices.next(4));
    const FieldSpan fields = fields_of(group);
    for (std::size_t i = fields.first; i < fields.first + fields.count; ++i) {
      const std::uint32_t part = choices.next(2);  // a little past both ends too; NaN
      const FieldRow& row = kFields[i];
      if (part == 0xFFFF) continue;
      snapshot.values[i] = row.min + (row.max - row.min) * (part / 60'000.0 - 0.04);
    }
  }
  CodecCounters counters;
  writer.add_groups(snapshot, wanted.span(), now, counters);
  while (choices.next() % 4 != 0) {
    const auto type = static_cast<RecordType>(1 + choices.next() % kRecordTypeMax);
    if (!writer.add_record(type, choices.take(choices.next(2) % 300))) break;
  }
  CHECK(writer.bytes().size() <= room);
  return {writer.bytes().begin(), writer.bytes().end()};
}

void read_header(std::span<const std::uint8_t> bytes) {
  const auto header = parse_header(bytes);
  if (!header) return;
  std::array<std::uint8_t, kHeaderSize> again{};
  write_header(*header, again);
  CHECK(std::ranges::equal(again, bytes.first(kHeaderSize)));
}

}  // namespace

// A byte that says which direction and which half, then the packet or the choices.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::span input(data, size);
  read_header(input);
  if (size == 0) return 0;
  const auto direction = static_cast<Direction>(data[0] & 1U);
  if ((data[0] & 2U) == 0) {
    const Bytes bytes(data + 1, data + size);
    read_both(bytes, direction);
    read_in_part(bytes, direction, size > 8 ? data[5] * 0x01010101U : 0);
    return 0;
  }
  Choices choices(input.subspan(1));
  Bytes bytes = written(choices, direction);
  CHECK(parse_body(bytes, direction).has_value());
  read_in_part(bytes, direction, choices.next(4));
  while (!choices.empty()) {
    bytes[choices.next(2) % bytes.size()] ^= static_cast<std::uint8_t>(choices.next());
  }
  read_both(bytes, direction);
  return 0;
}

// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/packet/body.hpp"

#include <algorithm>
#include <array>
#include <bit>

#include "protocol/vocabulary/bytes.hpp"
#include "protocol/vocabulary/check.hpp"

namespace pitwall::telemetry {

namespace {

constexpr std::uint8_t kHasAck = 1, kHasGroups = 2;
constexpr unsigned kPathsShift = 2;
constexpr std::uint8_t kAllPaths = (1U << kPaths) - 1U;
constexpr std::uint8_t kFlagsUsed = kHasAck | kHasGroups | kAllPaths << kPathsShift;
constexpr std::size_t kTimeSize = 3, kFlagsAt = kTimeSize;
static_assert(kBodyFixed == kFlagsAt + 1);
static_assert(kPaths <= 4);

constexpr std::uint8_t kLongLength = 0xF0;  // and above: four more significant bits of two bytes
constexpr std::size_t kLengthMax = 0xFFF;
static_assert(kMaxBody <= kLengthMax);

constexpr Duration kTick = microseconds(100);
constexpr std::uint16_t kHoldMax = 0xFFFF;

// Bytes that a set takes with its ages and values.
std::size_t groups_size(const Layout& layout, std::size_t bits) {
  return set_size(layout) + (bits + 7) / 8;
}

std::uint16_t hold_code(Duration hold) {
  const std::int64_t ticks = (hold + kTick / 2) / kTick;
  return static_cast<std::uint16_t>(std::clamp<std::int64_t>(ticks, 0, kHoldMax));
}

constexpr Layout layout_of(Direction direction) {
  Layout layout;
  for (const GroupRow& row : kGroupTable) {
    if (row.direction != direction) continue;
    const auto bits = static_cast<std::uint16_t>(group_bits(row.group));
    CHECK(layout.push({row.group, bits}));
  }
  return layout;
}
constexpr std::array kOwnLayouts{layout_of(Direction::kDown), layout_of(Direction::kUp)};

}  // namespace

const Layout& own_layout(Direction direction) {
  return kOwnLayouts[static_cast<std::size_t>(direction)];
}

BodyWriter::BodyWriter(std::span<std::uint8_t> buffer, std::size_t room, const Layout& layout)
    : buffer_(buffer), room_(room), layout_(&layout) {
  CHECK(room <= buffer.size() && room <= kMaxBody);
}

void BodyWriter::begin(Instant now, std::uint8_t paths_mask) {
  CHECK(at_ == 0 && room_ >= kBodyFixed && paths_mask <= kAllPaths);
  const auto ticks = static_cast<std::uint64_t>(now.ns / kTick.ns);
  store(buffer_.first(kTimeSize), ticks);
  buffer_[kFlagsAt] = static_cast<std::uint8_t>(paths_mask << kPathsShift);
  at_ = kBodyFixed;
}

bool BodyWriter::add_ack(const Ack& ack) {
  CHECK(at_ == kBodyFixed);
  if (room_left() < kAckSize) return false;
  buffer_[kFlagsAt] |= kHasAck;
  store<std::uint16_t>(buffer_, at_, ack.newest_low);
  store<std::uint32_t>(buffer_, at_ + 2, ack.mask);
  store<std::uint16_t>(buffer_, at_ + 6, hold_code(ack.hold));
  at_ += kAckSize;
  return true;
}

GroupSet BodyWriter::add_groups(const Snapshot& snapshot, std::span<const Group> wanted,
                                Instant now, CodecCounters& counters) {
  CHECK(at_ >= kBodyFixed && records_ == 0 && (buffer_[kFlagsAt] & kHasGroups) == 0);
  GroupSet known, set;
  for (const GroupPlace& place : *layout_) {
    if (place.own) known.add(*place.own);
  }
  std::size_t bits = 0;
  for (const Group group : wanted) {
    const std::size_t more = bits + kAgeCodeBits + group_bits(group);
    if (!known.has(group) || set.has(group)) continue;
    if (groups_size(*layout_, more) > room_left()) continue;
    set.add(group);
    bits = more;
  }
  if (set.empty()) return set;
  buffer_[kFlagsAt] |= kHasGroups;
  write_values(write_set(set).span(), snapshot, now, counters);
  return set;
}

// The groups of the set in the order of the layout.
FixedVector<Group, kGroups> BodyWriter::write_set(GroupSet set) {
  FixedVector<Group, kGroups> groups;
  std::uint64_t present = 0;
  for (std::size_t k = 0; k < layout_->size(); ++k) {
    const auto& own = (*layout_)[k].own;
    if (!own || !set.has(*own)) continue;
    present |= std::uint64_t{1} << k;
    CHECK(groups.push(*own));
  }
  const std::size_t size = set_size(*layout_);
  store(buffer_.subspan(at_, size), present);
  at_ += size;
  return groups;
}

void BodyWriter::write_values(std::span<const Group> groups, const Snapshot& snapshot, Instant now,
                              CodecCounters& counters) {
  bits::BitWriter out(buffer_.subspan(at_, room_left()));
  FieldWriter fields(out);
  Instant last = kNeverSampled;  // most groups are of one moment
  std::uint8_t code = kNeverCode;
  fields.write([&](auto&& put) {
    for (const Group group : groups) {
      const Instant at = snapshot.at(group);
      if (at != last) code = snapshot.ever(group) ? age_code(now - at) : kNeverCode;
      last = at;
      put(code, kAgeCodeBits);
    }
  });
  for (const Group group : groups) encode_group(group, snapshot.values, fields, counters);
  fields.finish();
  out.align();
  CHECK(out.ok());
  at_ += out.bytes();
}

bool BodyWriter::add_record(RecordType type, std::span<const std::uint8_t> payload) {
  CHECK(at_ >= kBodyFixed && payload.size() <= kLengthMax);
  if (records_ == kMaxRecords || record_size(payload.size()) > room_left()) return false;
  buffer_[at_++] = static_cast<std::uint8_t>(type);
  const auto length = static_cast<unsigned>(payload.size());
  if (length >= kLongLength) {
    buffer_[at_++] = static_cast<std::uint8_t>(kLongLength | length >> 8U);
  }
  buffer_[at_++] = static_cast<std::uint8_t>(length);
  std::copy(payload.begin(), payload.end(), buffer_.begin() + static_cast<std::ptrdiff_t>(at_));
  at_ += payload.size();
  ++records_;
  return true;
}

std::size_t BodyWriter::room_left() const {
  const std::size_t taken = at_ + held_back_;
  return room_ > taken ? room_ - taken : 0;
}

std::span<const std::uint8_t> BodyWriter::bytes() const { return buffer_.first(at_); }

const char* text_of(BodyError error) {
  constexpr std::array<const char*, kBodyErrors> kTexts{
      "ends before its time",
      "longer than any packet of this protocol",
      "flags that no sender sets",
      "groups that this direction does not have",
      "a bit pattern that no value makes",
      "bits after the last value are not zero",
      "a record of no type, or longer than the packet, or its length not in the shortest form",
      "more records than any sender writes"};
  return kTexts[static_cast<std::size_t>(error)];
}

namespace {

// What has not been read yet of a packet. Every take asks first whether there is so much.
class Rest {
 public:
  explicit Rest(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  bool has(std::size_t count) const { return bytes_.size() >= count; }
  bool empty() const { return bytes_.empty(); }
  std::span<const std::uint8_t> take(std::size_t count) {
    const auto taken = bytes_.first(count);
    bytes_ = bytes_.subspan(count);
    return taken;
  }
  std::uint8_t take_byte() { return take(1)[0]; }

 private:
  std::span<const std::uint8_t> bytes_;
};

using Verdict = std::optional<BodyError>;  // none: good so far

Verdict read_ack(Rest& rest, Body& body) {
  if (!rest.has(kAckSize)) return BodyError::kTooShort;
  const auto bytes = rest.take(kAckSize);
  body.ack = Ack{.newest_low = load<std::uint16_t>(bytes, 0),
                 .mask = load<std::uint32_t>(bytes, 2),
                 .hold = kTick * load<std::uint16_t>(bytes, 6)};
  return {};
}

Verdict read_set(Rest& rest, const Layout& sender, std::uint64_t& set) {
  const std::size_t size = set_size(sender);
  if (!rest.has(size)) return BodyError::kTooShort;
  set = load(rest.take(size));
  const auto used = static_cast<std::size_t>(std::bit_width(set));
  if (used == 0 || used > sender.size()) return BodyError::kBadGroups;
  return {};
}

// The places of a set in order: the first of those that are left, and the others.
const GroupPlace& first_place(const Layout& sender, std::uint64_t left) {
  return sender[static_cast<std::size_t>(std::countr_zero(left))];
}
constexpr std::uint64_t without_first(std::uint64_t left) { return left & (left - 1); }

template <class Take>
bool read_ages(Take&& take, const Layout& sender, std::uint64_t set, Body& body) {
  for (auto left = set; left != 0; left = without_first(left)) {
    const auto age = static_cast<std::uint8_t>(take(kAgeCodeBits));
    const auto& own = first_place(sender, left).own;
    if (!own) continue;
    body.groups.add(*own);
    body.age_codes[index_of(*own)] = age;
  }
  return true;
}

template <class Take>
bool skip(Take&& take, std::size_t bits) {
  constexpr unsigned kMost = 32;
  for (; bits > kMost; bits -= kMost) take(kMost);
  take(static_cast<unsigned>(bits));
  return true;
}

Verdict read_values(Rest& rest, const Layout& sender, std::uint64_t set, Body& body) {
  std::size_t bits = 0;
  for (auto left = set; left != 0; left = without_first(left)) {
    bits += kAgeCodeBits + first_place(sender, left).bits;
  }
  const std::size_t size = (bits + 7) / 8;
  if (!rest.has(size)) return BodyError::kTooShort;
  bits::BitReader in(rest.take(size));
  FieldReader fields(in, bits);
  fields.read([&](auto&& take) { return read_ages(take, sender, set, body); });
  for (auto left = set; left != 0; left = without_first(left)) {
    const GroupPlace& place = first_place(sender, left);
    if (!place.own) {
      fields.read([&](auto&& take) { return skip(take, place.bits); });
    } else if (!decode_group(*place.own, fields, body.values)) {
      return BodyError::kBadValue;
    }
  }
  if (!in.align()) return BodyError::kBadPadding;
  return {};
}

Verdict read_record(Rest& rest, Body& body) {
  const std::uint8_t type = rest.take_byte();
  if (type == 0 || type > kRecordTypeMax || rest.empty()) return BodyError::kBadRecord;
  std::size_t length = rest.take_byte();
  if (length >= kLongLength) {
    if (rest.empty()) return BodyError::kBadRecord;
    length = (length - kLongLength) << 8U | rest.take_byte();
    if (length < kLongLength) return BodyError::kBadRecord;
  }
  if (!rest.has(length)) return BodyError::kBadRecord;
  const Record record{static_cast<RecordType>(type), rest.take(length)};
  if (!body.records.push(record)) return BodyError::kTooManyRecords;
  return {};
}

Verdict read_body(Rest rest, const Layout& sender, Body& body) {
  if (!rest.has(kBodyFixed)) return BodyError::kTooShort;
  body.tx_time_100us = static_cast<std::uint32_t>(load(rest.take(kTimeSize)));
  const std::uint8_t flags = rest.take_byte();
  if ((flags & ~kFlagsUsed) != 0) return BodyError::kBadFlags;
  body.paths_mask = static_cast<std::uint8_t>(flags >> kPathsShift);
  Verdict bad;
  if ((flags & kHasAck) != 0 && (bad = read_ack(rest, body))) return bad;
  if ((flags & kHasGroups) != 0) {
    std::uint64_t set = 0;
    if ((bad = read_set(rest, sender, set))) return bad;
    if ((bad = read_values(rest, sender, set, body))) return bad;
  }
  while (!rest.empty()) {
    if ((bad = read_record(rest, body))) return bad;
  }
  return {};
}

}  // namespace

Result<Body, BodyError> parse_body(std::span<const std::uint8_t> bytes, const Layout& sender) {
  // One object from here to the caller: a body is 4 kB.
  Result<Body, BodyError> result{std::in_place};
  const Verdict bad = bytes.size() > kMaxBody ? BodyError::kTooLong
                                              : read_body(Rest{bytes}, sender, result.value());
  if (bad) result = Unexpected{*bad};
  return result;
}

}  // namespace pitwall::telemetry

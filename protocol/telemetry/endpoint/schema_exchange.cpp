// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/endpoint/schema_exchange.hpp"

#include <algorithm>

#include "protocol/telemetry/registry/schema.hpp"
#include "protocol/vocabulary/bytes.hpp"

namespace pitwall::telemetry {
namespace {

SchemaDescription make_own_claim() {
  SchemaDescription claim;
  for (const Direction direction : {Direction::kDown, Direction::kUp}) {
    SchemaDescription::Places& places = direction == Direction::kDown ? claim.down : claim.up;
    for (const GroupPlace& place : own_layout(direction)) {
      CHECK(places.push({static_cast<std::uint32_t>(group_hash(*place.own)), place}));
    }
  }
  claim.safety_hash = kSafetyHash;
  claim.whole_hash = kSchemaHash;
  return claim;
}

Layout layout_of(const SchemaDescription::Places& places) {
  Layout layout;
  for (const SchemaDescription::Place& place : places) CHECK(layout.push(place.group));
  return layout;
}

Direction other(Direction direction) {
  return direction == Direction::kDown ? Direction::kUp : Direction::kDown;
}

}  // namespace

const SchemaDescription& own_schema() {
  static const SchemaDescription kClaim = make_own_claim();
  return kClaim;
}

SchemaExchange::SchemaExchange(const SchemaDescription& own, Direction sends)
    : own_(&own),
      sends_(sends),
      sending_(layout_of(own.of(sends))),
      own_reading_(layout_of(own.of(other(sends)))),
      reading_(own_reading_) {}

void SchemaExchange::begin(std::uint64_t peer_whole_hash) {
  differs_ = peer_whole_hash != own_->whole_hash;
  peer_has_ours_ = false;
  next_ = 0;
  total_ = 0;
  received_ = 0;
  reading_ = own_reading_;
  if (differs_) reading_.clear();  // nothing is read before the list is here
}

bool SchemaExchange::complete() const {
  return total_ > 0 &&
         received_ == (total_ < 64 ? (std::uint64_t{1} << total_) - 1 : ~std::uint64_t{0});
}

bool SchemaExchange::take(std::span<const std::uint8_t> payload) {
  if (!differs_ || payload.size() < kHead || (payload.size() - kHead) % kEntry != 0) return false;
  const std::size_t count = (payload.size() - kHead) / kEntry, first = payload[2];
  const std::uint8_t total = payload[1];
  const bool sane = payload[0] <= 1 && total > 0 && total <= kMaxPlaces && first + count <= total;
  if (!sane || (total_ != 0 && total != total_)) return false;
  total_ = total;
  if (payload[0] == 1) peer_has_ours_ = true;
  for (std::size_t i = 0; i < count; ++i) {
    const auto hash = load<std::uint32_t>(payload, kHead + i * kEntry);
    const auto bits = load<std::uint16_t>(payload, kHead + i * kEntry + 4);
    GroupPlace place{.own = {}, .bits = bits};
    for (const SchemaDescription::Place& ours : own_->of(other(sends_))) {
      if (ours.hash == hash && ours.group.bits == bits) place = ours.group;
    }
    places_[first + i] = place;
    received_ |= std::uint64_t{1} << (first + i);
  }
  if (!complete() || !reading_.empty()) return true;
  for (std::size_t k = 0; k < total_; ++k) CHECK(reading_.push(places_[k]));
  return true;
}

std::size_t SchemaExchange::size() const {
  if (!differs_) return 0;
  const std::size_t rest = own_->of(sends_).size() - next_;
  const std::size_t entries = peer_has_ours_ ? 0 : std::min(kPerRecord, rest);
  return BodyWriter::record_size(kHead + entries * kEntry);
}

// The list in turns until the peer has it; that we have his, in every packet.
void SchemaExchange::write(BodyWriter& body) {
  if (!differs_) return;
  const SchemaDescription::Places& places = own_->of(sends_);
  std::array<std::uint8_t, kHead + kPerRecord * kEntry> bytes{};
  bytes[0] = complete() ? 1 : 0;
  bytes[1] = static_cast<std::uint8_t>(places.size());
  bytes[2] = static_cast<std::uint8_t>(next_);
  const std::size_t count = peer_has_ours_ ? 0 : std::min(kPerRecord, places.size() - next_);
  for (std::size_t i = 0; i < count; ++i) {
    store<std::uint32_t>(bytes, kHead + i * kEntry, places[next_ + i].hash);
    store<std::uint16_t>(bytes, kHead + i * kEntry + 4, places[next_ + i].group.bits);
  }
  const std::span payload = std::span(bytes).first(kHead + count * kEntry);
  if (!body.add_record(RecordType::kSchema, payload)) return;
  next_ = next_ + count >= places.size() ? 0 : next_ + count;
}

}  // namespace pitwall::telemetry

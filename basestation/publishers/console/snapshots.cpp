// SPDX-License-Identifier: Apache-2.0
#include "basestation/publishers/console/snapshots.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>

namespace pitwall::publishers::console {
namespace {

using state::FieldId;

// Safety fields that change all the time and mean nothing by it.
constexpr std::array kRestless{telemetry::field("uplink.link_age"),
                               telemetry::field("flags.heartbeat_age")};

bool is_watched(FieldId id) {
  if (state::is_base(id)) return state::base_field(id) == state::BaseField::kLinkState;
  const telemetry::FieldRow& row = telemetry::kFields[id];
  return row.priority() == telemetry::Class::kSafety &&
         std::ranges::find(kRestless, telemetry::FieldIndex{id}) == kRestless.end();
}

bool same_value(float a, double b) {
  return std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(static_cast<float>(b));
}

}  // namespace

std::vector<FieldId> reported_fields() {
  std::vector<FieldId> fields;
  for (telemetry::FieldIndex i = 0; i < telemetry::kFieldCount; ++i) {
    const telemetry::GroupRow& group = telemetry::row_of(telemetry::kFields[i].group);
    if (group.direction == telemetry::Direction::kDown) fields.push_back(state::id_of(i));
  }
  for (const state::BaseRow& row : state::kBaseTable) fields.push_back(state::id_of(row.field));
  return fields;
}

Snapshots::Snapshots() : fields_(reported_fields()), reported_(fields_.size()) {
  for (std::size_t i = 0; i < fields_.size(); ++i) {
    if (is_watched(fields_[i])) watched_.push_back(static_cast<FieldId>(i));
  }
}

bool Snapshots::safety_changed(const StateSource& source, Instant now) const {
  return std::ranges::any_of(watched_, [&](std::size_t place) {
    return !same_value(reported_[place].value, source.view(fields_[place], now).value);
  });
}

std::optional<Frame> Snapshots::make(const StateSource& source, Instant now) {
  const Duration since = now - last_;
  const bool at_once = news_ && safety_changed(source, now);
  if (!at_once && !full_wanted_ && since < kAtLatest && !(news_ && since >= kEvery)) {
    news_ = false;
    return std::nullopt;
  }
  const bool full = full_wanted_ || now - last_full_ >= kFullEvery;
  Frame frame{.flags = static_cast<std::uint8_t>((at_once ? web::kAtOnce : 0) |
                                                 (full ? web::kFullPicture : 0)),
              .sequence = ++sequence_,
              .at = now};
  frame.entries.reserve(fields_.size() * web::kSnapshotEntry);
  for (std::size_t i = 0; i < fields_.size(); ++i) {
    const state::FieldView view = source.view(fields_[i], now);
    const Entry entry = web::entry_of(fields_[i], view, source.evaluate(fields_[i], view));
    if (!full && entry.same(reported_[i])) continue;
    reported_[i] = entry;
    append(frame, entry);
  }
  last_ = now;
  if (full) last_full_ = now;
  news_ = full_wanted_ = false;
  return frame;
}

}  // namespace pitwall::publishers::console

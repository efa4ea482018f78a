// Re-encoding of a decoded packet body, to prove that each content has exactly one encoding.
//   in     a Body from parse_body(), and its direction
//   out    the bytes that BodyWriter writes for the same content
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "protocol/telemetry/packet/body.hpp"

namespace pitwall::testing {

inline std::vector<std::uint8_t> reencode_body(const telemetry::Body& body,
                                               telemetry::Direction direction) {
  using namespace telemetry;
  std::vector<std::uint8_t> buffer(kMaxBody);
  BodyWriter writer(buffer, kMaxBody, direction);
  const Instant now{std::int64_t{body.tx_time_100us} * 100'000};
  writer.begin(now, body.paths_mask);
  if (body.ack) CHECK(writer.add_ack(*body.ack));
  Snapshot snapshot;
  snapshot.values = body.values;
  FixedVector<Group, kGroups> wanted;
  for (const GroupRow& row : kGroupTable) {
    if (!body.groups.has(row.group)) continue;
    const std::uint8_t code = body.age_codes[index_of(row.group)];
    if (code != kNeverCode) snapshot.at(row.group) = now - age_of_code(code);
    CHECK(wanted.push(row.group));
  }
  CodecCounters counters;
  CHECK(writer.add_groups(snapshot, wanted.span(), now, counters) == body.groups);
  CHECK(counters.saturated == 0 && counters.not_finite == 0);
  for (const Record& record : body.records) CHECK(writer.add_record(record.type, record.payload));
  return {writer.bytes().begin(), writer.bytes().end()};
}

}  // namespace pitwall::testing

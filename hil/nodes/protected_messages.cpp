// SPDX-License-Identifier: Apache-2.0
#include "hil/nodes/protected_messages.hpp"

#include "protocol/can/av21.hpp"
#include "protocol/can/integrity_bench.hpp"
#include "protocol/vocabulary/check.hpp"

namespace pitwall::can_variant {
namespace {

constexpr std::array<std::uint32_t, kProtectedMessages> kIds{272, 288, 304, 320};

constexpr can::MessageRow row_with(std::uint32_t id) {
  for (const can::MessageRow& row : can::integrity_bench::kMessages)
    if (row.id == id) return row;
  return {};
}

constexpr std::array<can::MessageRow, kProtectedMessages> kRows{
    row_with(kIds[0]), row_with(kIds[1]), row_with(kIds[2]), row_with(kIds[3])};
constexpr std::uint32_t kFlagsId = 1200;  // base_to_car_summary: its last two bytes are free

constexpr can::MessageRow flags_row() {
  for (can::MessageRow row : can::av21::kMessages) {
    if (row.id != kFlagsId) continue;
    row.protection = {.profile = can::Protection::kJ1850, .length = row.length, .crc_byte = 7};
    return row;
  }
  return {};
}
static_assert(flags_row().length == 8);

constexpr std::array<can::MessageRow, kProtectedMessages + 1> kJudged{kRows[0], kRows[1], kRows[2],
                                                                      kRows[3], flags_row()};

static_assert(kRows[0].protection.profile == can::Protection::kJ1850);
static_assert(kRows[1].protection.profile == can::Protection::kP01);
static_assert(kRows[2].protection.profile == can::Protection::kP02);
static_assert(kRows[3].protection.profile == can::Protection::kP05);

}  // namespace

std::span<const can::MessageRow> protected_rows() { return kRows; }

std::span<const can::MessageRow> judged_rows() { return kJudged; }

can::Frame with_checksum(const can::Frame& frame) {
  if (frame.id != kFlagsId || frame.extended) return frame;
  can::Frame out = frame;
  can::ProtectState uncounted;
  can::protect(flags_row().protection, uncounted, out);
  return out;
}

const can::MessageRow* protected_row(std::uint32_t id) {
  for (const can::MessageRow& row : kRows)
    if (row.id == id) return &row;
  return nullptr;
}

FixedVector<can::Frame, kProtectedMessages> ProtectedMessages::due(Instant now) {
  FixedVector<can::Frame, kProtectedMessages> out;
  for (std::size_t i = 0; i < kRows.size(); ++i) {
    if (due_[i] > now) continue;
    due_[i] += kRows[i].period * ((now - due_[i]) / kRows[i].period + 1);
    can::Frame frame;
    frame.id = kRows[i].id;
    frame.length = kRows[i].length;
    content_ += 0x9E37U;
    frame.data[4] = static_cast<std::uint8_t>(content_ & 0xFFU);
    frame.data[5] = static_cast<std::uint8_t>(content_ >> 8U & 0xFFU);
    can::protect(kRows[i].protection, states_[i], frame);
    CHECK(out.push(frame));
  }
  return out;
}

}  // namespace pitwall::can_variant

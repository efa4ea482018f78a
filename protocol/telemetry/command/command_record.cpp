// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/command/command_record.hpp"

#include <algorithm>

#include "protocol/vocabulary/bytes.hpp"

namespace pitwall::telemetry {
namespace {

constexpr std::size_t kNumberAt = 0, kRunAt = 4;
constexpr std::size_t kBootAt = 8, kTypeAt = 12, kStepAt = 13, kAgeAt = 15, kIssuerAt = 17;
constexpr std::size_t kOutcomeAt = 8;
constexpr std::int64_t kAgeUnit = 1'000'000, kAgeMax = 65'535;
// The packet's time of sending is written in steps of 100 us.
constexpr Duration kSendingStep = microseconds(100);

std::uint16_t age_in_ms(Duration age) {
  const std::int64_t ns = std::max<std::int64_t>((age + kSendingStep).ns, 0);
  return static_cast<std::uint16_t>(std::min(ns / kAgeUnit + 1, kAgeMax));
}

}  // namespace

Command CommandRecord::command() const {
  const auto kind = static_cast<CommandType>(type);
  return {kind, row_of(kind).quantized().decode(step), issuer};
}

std::array<std::uint8_t, kCommandSize> to_bytes(const CommandRecord& record) {
  std::array<std::uint8_t, kCommandSize> bytes{};
  store(bytes, kNumberAt, record.number);
  store(bytes, kRunAt, record.base_run);
  store(bytes, kBootAt, record.car_boot);
  store(bytes, kTypeAt, record.type);
  store(bytes, kStepAt, record.step);
  store(bytes, kAgeAt, age_in_ms(record.age));
  store(bytes, kIssuerAt, record.issuer);
  return bytes;
}

std::optional<CommandRecord> parse_command(std::span<const std::uint8_t> payload) {
  if (payload.size() != kCommandSize) return std::nullopt;
  const CommandRecord record{.number = load<std::uint32_t>(payload, kNumberAt),
                             .base_run = load<std::uint32_t>(payload, kRunAt),
                             .car_boot = load<std::uint32_t>(payload, kBootAt),
                             .type = load<std::uint8_t>(payload, kTypeAt),
                             .step = load<std::uint16_t>(payload, kStepAt),
                             .age = milliseconds(load<std::uint16_t>(payload, kAgeAt)),
                             .issuer = load<std::uint8_t>(payload, kIssuerAt)};
  if (record.number == 0 || record.age.ns == 0) return std::nullopt;
  if (!record.known()) return record;
  const CommandRow& row = kCommandTable[record.type];
  if (record.step >= row.quantized().count()) return std::nullopt;
  return record;
}

std::array<std::uint8_t, kResultSize> to_bytes(const ResultRecord& record) {
  std::array<std::uint8_t, kResultSize> bytes{};
  store(bytes, kNumberAt, record.number);
  store(bytes, kRunAt, record.base_run);
  store(bytes, kOutcomeAt, static_cast<std::uint8_t>(record.outcome));
  return bytes;
}

std::optional<ResultRecord> parse_result(std::span<const std::uint8_t> payload) {
  if (payload.size() != kResultSize || payload[kOutcomeAt] >= kOutcomes) return std::nullopt;
  const ResultRecord record{load<std::uint32_t>(payload, kNumberAt),
                            load<std::uint32_t>(payload, kRunAt),
                            static_cast<Outcome>(payload[kOutcomeAt])};
  if (record.number == 0) return std::nullopt;
  return record;
}

std::array<std::uint8_t, kResultAckSize> to_bytes(const ResultAckRecord& record) {
  std::array<std::uint8_t, kResultAckSize> bytes{};
  store(bytes, kNumberAt, record.number);
  store(bytes, kRunAt, record.base_run);
  return bytes;
}

std::optional<ResultAckRecord> parse_result_ack(std::span<const std::uint8_t> payload) {
  if (payload.size() != kResultAckSize) return std::nullopt;
  const ResultAckRecord record{load<std::uint32_t>(payload, kNumberAt),
                               load<std::uint32_t>(payload, kRunAt)};
  if (record.number == 0) return std::nullopt;
  return record;
}

}  // namespace pitwall::telemetry

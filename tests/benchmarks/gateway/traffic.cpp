// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/gateway/traffic.hpp"

#include <algorithm>
#include <tuple>

#include "protocol/can/av21.hpp"
#include "protocol/can/signal.hpp"
#include "protocol/vocabulary/check.hpp"
#include "protocol/vocabulary/random.hpp"

namespace pitwall::load {
namespace {

constexpr std::size_t kForeign = 266;
constexpr Duration kFastest = milliseconds(10);  // of the car
constexpr std::uint8_t kForeignLength = 8;
constexpr std::size_t kNumberByte = 4, kNumberBytes = 4;
constexpr std::uint32_t kSettled = 3;  // frames before the first that may be left out
// Between two omissions of one message, so that each report belongs to one of them only.
constexpr std::uint32_t kApartFrames = 4;
constexpr Duration kApart = milliseconds(300);
constexpr std::size_t kNone = ~std::size_t{0};

can::MessageRow foreign_row(std::size_t index, Duration period) {
  can::MessageRow row{};
  row.id = kNumberedId + static_cast<std::uint32_t>(index);
  row.length = kForeignLength;
  row.name = "foreign";
  row.direction = can::Direction::kFromCar;
  row.safety = can::SafetyClass::kInformation;
  row.required = true;
  row.period = period;
  row.timeout = 5 * period;
  row.has_counter = index % 2 == 1;
  row.counter_start = 0;
  row.counter_bits = 8;
  return row;
}

// All zero bytes are plausible for every message of the car but these, where they are -100 degrees.
constexpr std::uint8_t kPlausibleTyreByte = 5;  // twice that: 28.5 degrees
bool is_tyre_temperature(std::uint32_t id) {
  return id >= can::av21::TireTempFl1::kId && id <= can::av21::TireTempRr4::kId;
}

void put(can::Frame& frame, unsigned start, unsigned bits, std::uint64_t value) {
  std::uint64_t word = can::load_intel(frame.data);
  word &= ~(can::mask_of(bits) << start);
  can::store_intel(frame.data, word | (value & can::mask_of(bits)) << start);
}

}  // namespace

std::uint32_t number_of(const can::Frame& frame) {
  return static_cast<std::uint32_t>(can::load_intel(frame.data, kNumberByte) &
                                    can::mask_of(8 * kNumberBytes));
}

Traffic::Traffic(const TrafficPlan& plan) : length_(plan.length), by_id_(can::kMaxStandardId + 1) {
  CHECK(length_.ns % kBatch.ns == 0);
  std::vector<can::MessageRow> rows;
  for (const can::MessageRow& row : can::av21::kMessages)
    if (row.direction == can::Direction::kFromCar) rows.push_back(row);
  const std::size_t of_car = rows.size();
  for (std::size_t i = 0; i < kForeign; ++i) rows.push_back(foreign_row(i, plan.foreign_period));
  std::fill(by_id_.begin(), by_id_.end(), kNone);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto batches = static_cast<std::size_t>(rows[i].period / kBatch);
    const Duration phase = static_cast<std::int64_t>(i % batches) * kBatch;
    CHECK(by_id_[rows[i].id] == kNone);
    by_id_[rows[i].id] = i;
    streams_.push_back({.row = rows[i], .phase = phase, .of_car = i < of_car});
    scheduled_ += count_of(streams_.back());
  }
  choose_omissions(plan);
}

std::uint32_t Traffic::count_of(const Stream& stream) const {
  if (length_ <= stream.phase) return 0;
  return static_cast<std::uint32_t>((length_ - stream.phase - nanoseconds(1)) / stream.row.period +
                                    1);
}

std::optional<std::size_t> Traffic::stream_of(std::uint32_t id) const {
  if (id >= by_id_.size() || by_id_[id] == kNone) return std::nullopt;
  return by_id_[id];
}

Duration Traffic::last_due(std::size_t stream) const {
  const Stream& s = streams_[stream];
  return s.phase + (static_cast<std::int64_t>(count_of(s)) - 1) * s.row.period;
}

std::uint64_t Traffic::sent(std::size_t stream) const {
  const auto omitted =
      std::count_if(omissions_.begin(), omissions_.end(),
                    [stream](const Omission& omission) { return omission.stream == stream; });
  return count_of(streams_[stream]) - static_cast<std::uint64_t>(omitted);
}

std::uint64_t Traffic::sent_of_car() const {
  std::uint64_t all = 0;
  for (std::size_t i = 0; i < streams_.size(); ++i)
    if (streams_[i].of_car) all += sent(i);
  return all;
}

bool Traffic::is_omitted(std::size_t stream, std::uint32_t index) const {
  const auto key = [](const Omission& o) { return std::tuple{o.stream, o.index}; };
  const auto at =
      std::lower_bound(omissions_.begin(), omissions_.end(), std::tuple{stream, index},
                       [&key](const Omission& o, const auto& wanted) { return key(o) < wanted; });
  return at != omissions_.end() && at->stream == stream && at->index == index;
}

bool Traffic::may_omit(std::size_t stream, std::uint32_t index) const {
  if (index < kSettled) return false;
  const Duration period = streams_[stream].row.period;
  const auto apart = std::max(kApartFrames, static_cast<std::uint32_t>((kApart + period) / period));
  return std::none_of(omissions_.begin(), omissions_.end(), [&](const Omission& o) {
    return o.stream == stream && (o.index > index ? o.index - index : index - o.index) < apart;
  });
}

void Traffic::omit(std::size_t stream, std::uint32_t index) {
  const Stream& s = streams_[stream];
  omissions_.push_back({stream, index, s.phase + static_cast<std::int64_t>(index) * s.row.period});
}

// The last frames of three streams first: the very last of the run, and the last of a message of
// the car with and without a counter. After them nothing comes any more that could betray them.
// The rest at random times; half of them of messages that the car knows.
void Traffic::choose_omissions(const TrafficPlan& plan) {
  if (plan.omissions == 0) return;
  std::size_t last = 0;
  std::optional<std::size_t> counted, plain;
  for (std::size_t i = 0; i < streams_.size(); ++i) {
    const Stream& s = streams_[i];
    if (last_due(i) >= last_due(last)) last = i;
    if (!s.of_car || s.row.period > kFastest) continue;
    (s.row.has_counter ? counted : plain) = i;
  }
  CHECK(counted && plain);
  for (const std::size_t stream : {last, *counted, *plain})
    omit(stream, count_of(streams_[stream]) - 1);
  Random random{plan.seed};
  const auto of_car = static_cast<std::size_t>(
      std::count_if(streams_.begin(), streams_.end(), [](const Stream& s) { return s.of_car; }));
  // A short run has no room for many: tries are bounded.
  for (std::size_t tries = 0; omissions_.size() < plan.omissions && tries < 50 * plan.omissions;
       ++tries) {
    const std::size_t stream =
        tries % 2 == 0 ? random.below(of_car) : of_car + random.below(streams_.size() - of_car);
    if (count_of(streams_[stream]) <= kSettled) continue;
    const auto index = static_cast<std::uint32_t>(random.below(count_of(streams_[stream])));
    if (may_omit(stream, index)) omit(stream, index);
  }
  std::sort(omissions_.begin(), omissions_.end(), [](const Omission& a, const Omission& b) {
    return std::tuple{a.stream, a.index} < std::tuple{b.stream, b.index};
  });
}

void Traffic::frames_due(Duration at, std::vector<can::Frame>& out) {
  for (std::size_t i = 0; i < streams_.size(); ++i) {
    const Stream& s = streams_[i];
    const Duration since = at - s.phase;
    if (since < Duration{} || since.ns % s.row.period.ns != 0) continue;
    const auto index = static_cast<std::uint32_t>(since / s.row.period);
    if (is_omitted(i, index)) continue;
    can::Frame frame;
    frame.id = s.row.id;
    frame.length = s.row.length;
    if (is_tyre_temperature(s.row.id))
      std::fill_n(frame.data.begin(), frame.length, kPlausibleTyreByte);
    if (s.row.has_counter) put(frame, s.row.counter_start, s.row.counter_bits, index);
    if (is_numbered(frame.id)) put(frame, 8 * kNumberByte, 8 * kNumberBytes, number_++);
    out.push_back(frame);
  }
}

}  // namespace pitwall::load

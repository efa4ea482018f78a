// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/packet/group_codec.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace pitwall::telemetry {
namespace {

constexpr auto kCodes = []<std::size_t... I>(std::index_sequence<I...>) {
  return std::array<bits::Quantized, sizeof...(I)>{kFields[I].quantized()...};
}
(std::make_index_sequence<kFieldCount>{});

constexpr std::size_t kMostFields = [] {
  std::size_t most = 0;
  for (const FieldSpan& span : kGroupFields) most = std::max(most, span.count);
  return most;
}();

// Dense where fast groups live (a tick of 10 ms, a slot of 20 ms), about threefold above.
constexpr std::array kAges{milliseconds(0),  milliseconds(2),  milliseconds(4),   milliseconds(6),
                           milliseconds(8),  milliseconds(10), milliseconds(14),  milliseconds(20),
                           milliseconds(30), milliseconds(50), milliseconds(100), milliseconds(250),
                           seconds(1),       seconds(10),      seconds(3'600)};
static_assert(kAges.size() == kNeverCode);
static_assert(std::is_sorted(kAges.begin(), kAges.end()));

// Fields put together in a register, so that the writer is called once for several of them.
class Gatherer {
 public:
  explicit Gatherer(bits::BitWriter& out) : out_(&out) {}

  void put(std::uint64_t step, unsigned bits) {
    if (bits > bits::kMaxFieldBits - bits_) flush();
    gathered_ = gathered_ << bits | step;
    bits_ += bits;
  }
  void flush() {
    out_->write(gathered_, bits_);
    gathered_ = bits_ = 0;
  }

 private:
  bits::BitWriter* out_;
  std::uint64_t gathered_ = 0;
  unsigned bits_ = 0;
};

}  // namespace

bool encode_group(Group group, const Values& values, bits::BitWriter& out,
                  CodecCounters& counters) {
  const auto [first, count] = fields_of(group);
  Gatherer fields(out);
  for (FieldIndex i = first; i < first + count; ++i) {
    const bits::Quantized& code = kCodes[i];
    if (std::isinf(values[i])) {
      ++counters.not_finite;
      fields.put(code.no_value(), code.bits());
      continue;
    }
    const bits::Encoded encoded = code.encode(values[i]);
    if (encoded.saturated) ++counters.saturated;
    fields.put(encoded.step, code.bits());
  }
  fields.flush();
  return out.ok();
}

bool decode_group(Group group, bits::BitReader& in, Values& values) {
  const auto [first, count] = fields_of(group);
  std::array<double, kMostFields> decoded;
  for (FieldIndex i = 0; i < count; ++i) {
    const bits::Quantized& code = kCodes[first + i];
    const std::uint64_t step = in.read(code.bits());
    if (step >= code.count() && step != code.no_value()) return false;
    decoded[i] = code.decode(step);
  }
  if (!in.ok()) return false;
  std::copy_n(decoded.begin(), count, values.at.begin() + static_cast<std::ptrdiff_t>(first));
  return true;
}

std::uint8_t age_code(Duration age) {
  const auto* const at = std::lower_bound(kAges.begin(), kAges.end(), age);
  return static_cast<std::uint8_t>(at - kAges.begin());  // past the end is kNeverCode
}

Duration age_of_code(std::uint8_t code) {
  CHECK(code < kNeverCode);
  return kAges[code];
}

}  // namespace pitwall::telemetry

// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/packet/group_codec.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace pitwall::telemetry {
namespace {

// A row as the codec needs it.
struct FieldCode {
  double min, resolution;
  std::int64_t last;  // code of the last value
  unsigned bits;
  std::uint64_t unset;
};
constexpr auto kCodes = [] {
  std::array<FieldCode, kFieldCount> codes{};
  for (FieldIndex i = 0; i < kFieldCount; ++i) {
    const bits::Quantized q = kFields[i].quantized();
    codes[i] = {q.min(), q.resolution(), static_cast<std::int64_t>(q.count()) - 1, q.bits(),
                q.no_value()};
  }
  return codes;
}();

constexpr unsigned kWord = 32;  // no field is wider; two fit into a register

// Fields gathered into words: a writer takes 32 bits at once sooner than a few at a time.
class Packer {
 public:
  explicit Packer(bits::BitWriter& out) : out_(out) {}
  void put(std::uint64_t value, unsigned bits) {
    word_ = word_ << bits | value;
    filled_ += bits;
    if (filled_ < kWord) return;
    filled_ -= kWord;
    out_.write(word_ >> filled_ & 0xFFFF'FFFFU, kWord);
  }
  bool finish() { return out_.write(word_ & ((std::uint64_t{1} << filled_) - 1), filled_); }

 private:
  bits::BitWriter& out_;
  std::uint64_t word_ = 0;
  unsigned filled_ = 0;  // < kWord between two fields
};

// The other way round; `total`: all bits that may be taken.
class Unpacker {
 public:
  Unpacker(bits::BitReader& in, std::size_t total) : in_(in), left_(total) {}
  std::uint64_t take(unsigned bits) {
    if (filled_ < bits) refill();
    filled_ -= bits;
    return word_ >> filled_ & ((std::uint64_t{1} << bits) - 1);
  }

 private:
  void refill() {
    const auto more = static_cast<unsigned>(std::min<std::size_t>(left_, kWord));
    word_ = word_ << more | in_.read(more);
    filled_ += more;
    left_ -= more;
  }

  bits::BitReader& in_;
  std::uint64_t word_ = 0;
  unsigned filled_ = 0;
  std::size_t left_;
};

// A value that has no code inside the range: unset, infinite, or held at an end.
std::uint64_t code_outside(FieldIndex i, double value, CodecCounters& counters) {
  if (std::isinf(value)) {
    ++counters.not_finite;
    return kCodes[i].unset;
  }
  const bits::Encoded encoded = kFields[i].quantized().encode(value);
  if (encoded.saturated) ++counters.saturated;
  return encoded.step;
}

std::uint64_t code_of(FieldIndex i, double value, CodecCounters& counters) {
  const FieldCode& code = kCodes[i];
  const double steps = (value - code.min) / code.resolution;
  const bool inside = steps >= 0.0 && steps <= static_cast<double>(code.last);
  if (!inside) return code_outside(i, value, counters);
  return static_cast<std::uint64_t>(static_cast<std::int64_t>(steps + 0.5));
}

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

}  // namespace

bool encode_group(Group group, const Values& values, bits::BitWriter& out,
                  CodecCounters& counters) {
  const auto [first, count] = fields_of(group);
  Packer packer{out};
  for (FieldIndex i = first; i < first + count; ++i)
    packer.put(code_of(i, values[i], counters), kCodes[i].bits);
  return packer.finish();
}

bool decode_group(Group group, bits::BitReader& in, Values& values) {
  const auto [first, count] = fields_of(group);
  if (in.bits_left() < group_bits(group)) return false;
  std::array<double, kMostFields> decoded;
  Unpacker unpacker{in, group_bits(group)};
  for (FieldIndex i = 0; i < count; ++i) {
    const FieldCode& code = kCodes[first + i];
    const std::uint64_t step = unpacker.take(code.bits);
    const auto number = static_cast<std::int64_t>(step);
    if (number <= code.last) {
      decoded[i] = code.min + static_cast<double>(number) * code.resolution;
    } else if (step == code.unset) {
      decoded[i] = kUnset;
    } else {
      return false;
    }
  }
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

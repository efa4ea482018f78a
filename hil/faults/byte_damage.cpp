// SPDX-License-Identifier: Apache-2.0
#include "hil/faults/byte_damage.hpp"

#include <algorithm>

#include "protocol/vocabulary/check.hpp"

namespace pitwall::faults {
namespace {

enum class Form : std::uint8_t {
  kBitsFlipped,
  kTailLost,
  kHeadLost,
  kGarbageInside,
  kGarbageBefore,
  kOlderPieceBefore,
  kOlderPieceInside
};
constexpr std::uint64_t kForms = 7;
constexpr std::uint64_t kMaxFlips = 16;
constexpr unsigned kBits = 8;

}  // namespace

ByteDamage::ByteDamage(std::vector<BenchFault> faults) : faults_(std::move(faults)) {
  for (const BenchFault& fault : faults_) random_.push_back({fault.seed});
}

std::span<const std::uint8_t> ByteDamage::pass(std::uint8_t unit,
                                               std::span<const std::uint8_t> message, Instant now) {
  CHECK(message.size() <= kMaxMessage && unit < kUnits);
  bool done = false;
  for (std::size_t i = 0; i < faults_.size(); ++i) {
    const BenchFault& fault = faults_[i];
    if (done || fault.unit != unit || !active(fault, now)) continue;
    if (message.empty() || random_[i].uniform() >= fault.value) continue;
    length_ = 0;
    damage(unit, message, random_[i]);
    ++damaged_;
    done = true;
  }
  if (!faults_.empty()) {
    Piece& older = older_[unit];
    older.length = message.size();
    std::ranges::copy(message, older.data.begin());
  }
  return done ? std::span<const std::uint8_t>(out_).first(length_) : message;
}

void ByteDamage::damage(std::uint8_t unit, std::span<const std::uint8_t> message, Random& random) {
  const auto form = static_cast<Form>(random.below(kForms));
  const auto cut = static_cast<std::size_t>(random.below(message.size()));
  const auto older = older_[unit].span();
  switch (form) {
    case Form::kBitsFlipped:
      put(message);
      return flip_bits(random);
    case Form::kTailLost:
      return put(message.first(cut));
    case Form::kHeadLost:
      return put(message.subspan(cut));
    case Form::kGarbageInside:
      put(message.first(cut));
      put_garbage(random);
      return put(message.subspan(cut));
    case Form::kGarbageBefore:
      put_garbage(random);
      return put(message);
    case Form::kOlderPieceBefore:
      put(older.first(std::min(cut, older.size())));
      return put(message);
    case Form::kOlderPieceInside:
      put(message.first(cut));
      put(older.subspan(std::min(cut, older.size())));
      return put(message.subspan(cut));
  }
}

void ByteDamage::put(std::span<const std::uint8_t> bytes) {
  std::ranges::copy(bytes, out_.begin() + static_cast<std::ptrdiff_t>(length_));
  length_ += bytes.size();
}

void ByteDamage::put_garbage(Random& random) {
  for (std::uint64_t left = 1 + random.below(kMaxGarbage); left > 0; --left)
    out_[length_++] = static_cast<std::uint8_t>(random.next());
}

void ByteDamage::flip_bits(Random& random) {
  for (std::uint64_t left = 1 + random.below(kMaxFlips); left > 0; --left) {
    const std::uint64_t bit = random.below(length_ * kBits);
    out_[bit / kBits] ^= static_cast<std::uint8_t>(1U << (bit % kBits));
  }
}

}  // namespace pitwall::faults

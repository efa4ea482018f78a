// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/attack/forgery.hpp"

#include <algorithm>

#include "protocol/telemetry/packet/header.hpp"

namespace pitwall::attack {
namespace {

constexpr std::size_t kMostFlips = 8, kMostMore = 64, kOversize = 8'000, kTries = 64;
constexpr std::uint8_t kKindBits = 0x1C;  // of the first byte; see header.hpp
constexpr unsigned kKindShift = 2;

}  // namespace

const Bytes& PacketForger::next(std::span<const Recorded> recorded, bool for_base) {
  const auto shape = static_cast<Shape>(turns_[for_base ? 1 : 0]++ % kShapes);
  const bool back = shape == Shape::kReflected;
  const Recorded* const from = draw(recorded, for_base != back);
  const Recorded* const other = draw(recorded, for_base);
  if (from == nullptr || other == nullptr) {
    fill(telemetry::kHeaderSize + telemetry::kTagSize + below(telemetry::kMaxBody));
  } else {
    make(shape, *from, *other);
  }
  return made_;
}

// Of this direction, wherever it lies; none where there seems to be none.
const Recorded* PacketForger::draw(std::span<const Recorded> recorded, bool from_car) {
  for (std::size_t i = 0; i < kTries && !recorded.empty(); ++i) {
    const Recorded& one = recorded[below(recorded.size())];
    if (one.from_car == from_car && one.bytes.size() > telemetry::kHeaderSize) return &one;
  }
  return nullptr;
}

void PacketForger::make(Shape shape, const Recorded& from, const Recorded& other) {
  made_ = from.bytes;
  switch (shape) {
    case Shape::kFlipped:
      return flip();
    case Shape::kCut:
      return made_.resize(below(made_.size()));
    case Shape::kLonger:
      for (std::size_t more = 1 + below(kMostMore); more > 0; --more)
        made_.push_back(static_cast<std::uint8_t>(random_()));
      return;
    case Shape::kSpliced: {
      const std::size_t at = telemetry::kHeaderSize;
      made_.resize(at);
      made_.insert(made_.end(), other.bytes.begin() + at, other.bytes.end());
      if (made_ == from.bytes) flip();
      return;
    }
    case Shape::kReflected:
      return;
    case Shape::kOtherKind: {
      const auto kind = static_cast<std::uint8_t>((1 + below(7)) << kKindShift);
      made_[0] = static_cast<std::uint8_t>(made_[0] ^ (kind & kKindBits));
      return;
    }
    case Shape::kOtherSession:
      made_[1] = static_cast<std::uint8_t>(made_[1] ^ (1 + below(255)));
      return;
    case Shape::kRandom:
      return fill(1 + below(telemetry::kMaxDatagram));
    case Shape::kEmpty:
      return made_.clear();
    case Shape::kOversized:
      return fill(kOversize);
  }
}

void PacketForger::flip() {
  const Bytes before = made_;
  while (made_ == before) {
    for (std::size_t flips = 1 + below(kMostFlips); flips > 0; --flips) {
      std::uint8_t& byte = made_[below(made_.size())];
      byte = static_cast<std::uint8_t>(byte ^ (1U << below(8)));
    }
  }
}

void PacketForger::fill(std::size_t size) {
  made_.resize(size);
  for (std::uint8_t& byte : made_) byte = static_cast<std::uint8_t>(random_());
}

}  // namespace pitwall::attack

// Samples for the tests of this folder: a struct with a field of every kind, and a file in memory.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <tuple>
#include <type_traits>
#include <vector>

#include "protocol/recording/cdr_struct.hpp"
#include "protocol/recording/mcap_writer.hpp"

namespace pitwall::recording::testing {

struct Sample {
  std::uint8_t mode = 0;
  double speed_mps = 0.0;  // after one byte: needs seven of padding
  bool armed = false;
  std::uint16_t gear = 0;
  std::uint32_t frames = 0;
  float share = 0.0F;
  CdrBytes<32> raw{};
  std::int64_t at_ns = 0;
  std::int32_t delta = 0;
  std::uint64_t total = 0;
};

constexpr CdrName cdr_name(std::type_identity<Sample>) { return "Sample"; }
constexpr auto cdr_fields(std::type_identity<Sample>) {
  return std::tuple{CdrField{"mode", &Sample::mode},     CdrField{"speed_mps", &Sample::speed_mps},
                    CdrField{"armed", &Sample::armed},   CdrField{"gear", &Sample::gear},
                    CdrField{"frames", &Sample::frames}, CdrField{"share", &Sample::share},
                    CdrField{"raw", &Sample::raw},       CdrField{"at_ns", &Sample::at_ns},
                    CdrField{"delta", &Sample::delta},   CdrField{"total", &Sample::total}};
}

// Extreme and ordinary values; the same for the same i.
inline Sample sample(std::uint32_t i) {
  Sample s;
  s.mode = static_cast<std::uint8_t>(i);
  s.speed_mps = i == 3 ? std::numeric_limits<double>::infinity() : 0.1 * i - 7.0;
  s.armed = i % 2 == 1;
  s.gear = static_cast<std::uint16_t>(i * 257U);
  s.frames = ~i;
  s.share = static_cast<float>(i) / 3.0F;
  for (std::uint32_t k = 0; k < i % 33; ++k) CHECK(s.raw.push(static_cast<std::uint8_t>(i + k)));
  s.at_ns = i == 5 ? std::numeric_limits<std::int64_t>::min() : std::int64_t{i} * 1'000'003;
  s.delta = -static_cast<std::int32_t>(i);
  s.total = i == 6 ? std::numeric_limits<std::uint64_t>::max() : i;
  return s;
}

struct MemoryFile {
  std::vector<std::uint8_t> bytes;

  Sink sink() {
    return [this](std::span<const std::uint8_t> more) {
      bytes.insert(bytes.end(), more.begin(), more.end());
      return true;
    };
  }
};

}  // namespace pitwall::recording::testing

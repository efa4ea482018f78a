// Messages with random fields: every value that a field can hold and that is not refused.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <random>
#include <type_traits>

#include "protocol/gnss/novatel_fields.hpp"
#include "protocol/gnss/vectornav_codec.hpp"
#include "protocol/gnss/vectornav_fields.hpp"
#include "tests/support/draw.hpp"

namespace pitwall::gnss {

class Filler {
 public:
  explicit Filler(std::mt19937_64& random) : random_(random) {}

  template <class... Field>
  void operator()(Kind kind, Field&... field) {
    (fill(kind, field), ...);
  }
  template <class... Field>
  void operator()(unsigned, Kind kind, Field&... field) {
    (fill(kind, field), ...);
  }
  void skip(unsigned, std::size_t) {}

 private:
  template <class T>
  void fill(Kind kind, T& value) {
    if constexpr (std::is_floating_point_v<T>) {
      value = number<T>(kind);
    } else if (kind == Kind::kEntries) {
      value = static_cast<T>(random_() % (kMostEntries + 1));
    } else if (kind == Kind::kHex || kind == Kind::kNumber || random_() % 2 == 0) {
      value = static_cast<T>(random_());
    } else {
      value = static_cast<T>(random_() % 100);  // most of these values have a name
    }
  }
  template <class T, std::size_t N>
  void fill(Kind kind, std::array<T, N>& values) {
    for (T& value : values) fill(kind, value);
  }
  // Printable, without quotes, of any length.
  void fill(Kind, std::array<char, 4>& text) {
    text = {};
    const std::size_t length = random_() % (text.size() + 1);
    for (std::size_t i = 0; i < length; ++i) text[i] = static_cast<char>('#' + random_() % 90);
  }

  template <class T>
  T number(Kind kind) {
    const auto within = [this](double limit) {
      return static_cast<T>(testing::draw_uniform(random_, -limit, limit));
    };
    if (kind == Kind::kLatitude) return within(90.0);
    if (kind == Kind::kLongitude) return within(180.0);
    if (kind == Kind::kSeconds) return static_cast<T>(testing::draw_uniform(random_) * 604'800.0);
    using Bits = std::conditional_t<sizeof(T) == 4, std::uint32_t, std::uint64_t>;
    T value{};
    do value = std::bit_cast<T>(static_cast<Bits>(random_()));
    while (!std::isfinite(value));
    return kind == Kind::kSigma ? std::abs(value) : value;
  }

  std::mt19937_64& random_;
};

inline constexpr std::size_t kLogs = std::variant_size_v<NovatelMessage>;

template <std::size_t I = 0>
NovatelMessage empty_message(std::size_t index) {
  if constexpr (I + 1 < kLogs) {
    if (index != I) return empty_message<I + 1>(index);
  }
  return NovatelMessage{std::in_place_index<I>};
}

inline NovatelMessage random_message(std::size_t index, std::mt19937_64& random) {
  NovatelMessage message = empty_message(index);
  Filler filler{random};
  std::visit([&](auto& m) { visit_fields(m, filler); }, message);
  return message;
}

// The port has an ASCII name, the time status has a name or not, everything else is random.
inline NovatelHeader random_header(std::mt19937_64& random) {
  constexpr std::array<std::uint8_t, 4> kPorts{0x20, 0x3E, 0x41, 0xA0};
  constexpr std::array<std::uint8_t, 4> kStatus{20, 100, 180, 77};
  NovatelHeader h;
  h.port = kPorts[random() % kPorts.size()];
  h.sequence = static_cast<std::uint16_t>(random());
  h.idle_time = static_cast<std::uint8_t>(random() % 201);
  h.time_status = kStatus[random() % kStatus.size()];
  h.week = static_cast<std::uint16_t>(random());
  h.milliseconds = static_cast<std::uint32_t>(random() % kWeek_ms);
  h.receiver_status = static_cast<std::uint32_t>(random());
  h.reserved = static_cast<std::uint16_t>(random());
  h.receiver_version = static_cast<std::uint16_t>(random());
  return h;
}

// The part of a header that the message's form of header (long or short) carries.
inline NovatelHeader as_sent(NovatelHeader h, const NovatelMessage& message) {
  std::visit([&h](const auto& m) { h.id = m.kId, h.short_form = m.kShort; }, message);
  if (!h.short_form) return h;
  NovatelHeader s;
  s.id = h.id, s.short_form = true, s.week = h.week, s.milliseconds = h.milliseconds;
  s.port = 0, s.time_status = 0;
  return s;
}

// At least one field, of some groups.
inline VectorNavOutput random_output(std::mt19937_64& random) {
  VectorNavOutput output;
  for (std::size_t i = 0; i < kVectorNavGroups; ++i) {
    const auto all = writable_fields(static_cast<VectorNavGroup>(i));
    if (random() % 2 == 0) output.fields[i] = static_cast<std::uint32_t>(random()) & all;
  }
  if (output == VectorNavOutput{}) output.of(VectorNavGroup::kIns) = 1;
  return output;
}

inline VectorNavMessage random_vectornav(const VectorNavOutput& output, std::mt19937_64& random) {
  VectorNavMessage message;
  message.output = output;
  Filler filler{random};
  for (std::size_t i = 0; i < kVectorNavGroups; ++i) {
    visit_fields(static_cast<VectorNavGroup>(i), message, filler);
  }
  return message;
}

}  // namespace pitwall::gnss

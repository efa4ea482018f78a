// Serialisation of flat structs as ROS 2 messages, so that MCAP tools (Foxglove, PlotJuggler) read
// every value. A struct S describes itself once, in its own namespace:
//
//   struct EgoSample { double speed_mps; std::uint8_t validity; };
//   constexpr CdrName cdr_name(std::type_identity<EgoSample>) { return "EgoSample"; }
//   constexpr auto cdr_fields(std::type_identity<EgoSample>) {
//     return std::tuple{CdrField{"speed_mps", &EgoSample::speed_mps},
//                       CdrField{"validity", &EgoSample::validity}};
//   }
//
// From that follow the name and text of the schema (encoding "ros2msg") and the bytes ("cdr").
//   fields float64, float32, int64, int32, uint64, uint32, uint16, uint8, bool, and
//          FixedVector<std::uint8_t, N> (sequence uint8[] of at most N bytes)
//   bytes  encapsulation header 00 01 00 00, then little-endian XCDR1: each number aligned to its
//          own size, counted from after the header
//   errors from_cdr() returns false for bytes that are too short, too long or of another
//          encapsulation, a sequence over its bound, or a bool other than 0 or 1; it never reads
//          past the end
//   cost   O(fields), no allocation in to_cdr and from_cdr
//   source OMG DDSI-RTPS 2.3, 10; ROS 2 interface definition
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>

#include "protocol/recording/mcap_writer.hpp"
#include "protocol/vocabulary/check.hpp"
#include "protocol/vocabulary/fixed_vector.hpp"

namespace pitwall::recording {

inline constexpr std::size_t kCdrHeaderBytes = 4;
inline constexpr std::array<std::uint8_t, kCdrHeaderBytes> kCdrHeader{0x00, 0x01, 0x00, 0x00};
static_assert(std::endian::native == std::endian::little, "numbers are copied as they lie");

using CdrName = std::string_view;

template <class S, class T>
struct CdrField {
  using Value = T;
  std::string_view name;
  T S::*member;
};
template <class S, class T>
CdrField(const char*, T S::*) -> CdrField<S, T>;

template <std::size_t N>
using CdrBytes = FixedVector<std::uint8_t, N>;

template <class T>
struct CdrSequence : std::false_type {};
template <std::size_t N>
struct CdrSequence<CdrBytes<N>> : std::true_type {};

// ROS 2 name of the type of a field.
template <class T>
constexpr std::string_view ros2_type() {
  if constexpr (CdrSequence<T>::value) return "uint8[]";
  if constexpr (std::is_same_v<T, double>) return "float64";
  if constexpr (std::is_same_v<T, float>) return "float32";
  if constexpr (std::is_same_v<T, std::int64_t>) return "int64";
  if constexpr (std::is_same_v<T, std::int32_t>) return "int32";
  if constexpr (std::is_same_v<T, std::uint64_t>) return "uint64";
  if constexpr (std::is_same_v<T, std::uint32_t>) return "uint32";
  if constexpr (std::is_same_v<T, std::uint16_t>) return "uint16";
  if constexpr (std::is_same_v<T, std::uint8_t>) return "uint8";
  if constexpr (std::is_same_v<T, bool>) return "bool";
}

// Largest size of a field of type T, with its alignment padding.
template <class T>
constexpr std::size_t cdr_field_bytes_max() {
  if constexpr (CdrSequence<T>::value) {
    return 2 * sizeof(std::uint32_t) - 1 + T::capacity();
  } else {
    return 2 * sizeof(T) - 1;
  }
}

template <class S>
constexpr std::size_t cdr_bytes_max() {
  return std::apply(
      [](const auto&... field) {
        return (kCdrHeaderBytes + ... +
                cdr_field_bytes_max<typename std::decay_t<decltype(field)>::Value>());
      },
      cdr_fields(std::type_identity<S>{}));
}

// Writer of numbers into a buffer that is large enough.
class CdrWriter {
 public:
  explicit CdrWriter(std::span<std::uint8_t> buffer) : buffer_(buffer) {
    CHECK(buffer.size() >= kCdrHeaderBytes);
    std::memcpy(buffer.data(), kCdrHeader.data(), kCdrHeaderBytes);
  }

  template <class T>
  void put(const T& v) {
    if constexpr (CdrSequence<T>::value) {
      put(static_cast<std::uint32_t>(v.size()));
      append(v.begin(), v.size());
    } else {
      static_assert(std::is_arithmetic_v<T>);
      constexpr std::array<std::uint8_t, sizeof(T)> kPadding{};
      append(kPadding.data(), (sizeof(T) - (size_ - kCdrHeaderBytes) % sizeof(T)) % sizeof(T));
      append(&v, sizeof(T));
    }
  }
  std::span<const std::uint8_t> bytes() const { return buffer_.first(size_); }

 private:
  void append(const void* from, std::size_t count) {
    CHECK(count <= buffer_.size() - size_);
    std::memcpy(buffer_.data() + size_, from, count);
    size_ += count;
  }

  std::span<std::uint8_t> buffer_;
  std::size_t size_ = kCdrHeaderBytes;
};

class CdrReader {
 public:
  explicit CdrReader(std::span<const std::uint8_t> bytes) : bytes_(bytes) {
    ok_ = bytes.size() >= kCdrHeaderBytes &&
          std::memcmp(bytes.data(), kCdrHeader.data(), kCdrHeaderBytes) == 0;
  }

  template <class T>
  void get(T& v) {
    if constexpr (CdrSequence<T>::value) {
      std::uint32_t count = 0;
      get(count);
      v.clear();
      for (const std::uint8_t byte : take(count)) ok_ = v.push(byte) && ok_;
    } else if constexpr (std::is_same_v<T, bool>) {
      std::uint8_t flag = 0;
      get(flag);
      ok_ = ok_ && flag <= 1;
      v = flag == 1;
    } else {
      take(ok_ ? (sizeof(T) - (at_ - kCdrHeaderBytes) % sizeof(T)) % sizeof(T) : 0);
      const auto raw = take(sizeof(T));
      if (ok_) std::memcpy(&v, raw.data(), sizeof(T));
    }
  }
  bool ok() const { return ok_; }
  bool at_end() const { return ok_ && at_ == bytes_.size(); }

 private:
  std::span<const std::uint8_t> take(std::size_t count) {
    ok_ = ok_ && count <= bytes_.size() - at_;
    if (!ok_) return {};
    at_ += count;
    return bytes_.subspan(at_ - count, count);
  }

  std::span<const std::uint8_t> bytes_;
  std::size_t at_ = kCdrHeaderBytes;
  bool ok_ = true;
};

// Writes `s` into `buffer` and returns the bytes in use.
template <class S>
std::span<const std::uint8_t> to_cdr(const S& s,
                                     std::span<std::uint8_t, cdr_bytes_max<S>()> buffer) {
  CdrWriter writer{buffer};
  std::apply([&](const auto&... field) { (writer.put(s.*field.member), ...); },
             cdr_fields(std::type_identity<S>{}));
  return writer.bytes();
}

template <class S>
[[nodiscard]] bool from_cdr(std::span<const std::uint8_t> bytes, S& s) {
  CdrReader reader{bytes};
  std::apply([&](const auto&... field) { (reader.get(s.*field.member), ...); },
             cdr_fields(std::type_identity<S>{}));
  return reader.at_end();
}

template <class S>
Schema cdr_schema() {
  std::string text;
  const auto line = [&text](const auto& field) {
    using Value = typename std::decay_t<decltype(field)>::Value;
    text.append(ros2_type<Value>()).append(" ").append(field.name).append("\n");
  };
  std::apply([&](const auto&... field) { (line(field), ...); },
             cdr_fields(std::type_identity<S>{}));
  const std::string name{cdr_name(std::type_identity<S>{})};
  return {"pitwall_msgs/msg/" + name, "ros2msg", text};
}

// Channel with messages of type S.
template <class S>
Channel cdr_channel(std::string topic) {
  return {std::move(topic), "cdr", cdr_schema<S>(), {}};
}

}  // namespace pitwall::recording

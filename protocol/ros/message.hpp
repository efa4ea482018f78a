// Definition of a ROS 2 message by one list of its fields. Encoder, decoder, .msg text and type
// hash are derived from it.
//
//     struct Header {
//       Time stamp;
//       std::string frame_id;
//       static constexpr std::string_view kType = "std_msgs/msg/Header";
//       static constexpr auto members() {
//         return std::tuple{field("stamp", &Header::stamp), field("frame_id", &Header::frame_id)};
//       }
//     };
//
//   invariants
//          fields are in the order of the .msg file; a field is a number, bool, Byte, string (with
//          or without a bound), another message, or a std::array (fixed length) or std::vector (any
//          length) of these
//   source rosidl, the .msg files of ROS 2 Humble to Jazzy
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <vector>

namespace pitwall::ros {

// `byte` of a .msg file: an IDL octet, which is a different type than `uint8`.
enum class Byte : std::uint8_t {};

// `string<=N` of a .msg file.
template <std::size_t N>
struct BoundedString : std::string {
  static constexpr std::size_t kBound = N;
  using std::string::operator=;
};

template <class T>
concept Text = std::is_base_of_v<std::string, T>;
template <class T>
concept BoundedText = Text<T> && requires {
  T::kBound;
};

template <class M, class T>
struct Field {
  std::string_view name;
  T M::*member;
};

template <class M, class T>
constexpr Field<M, T> field(std::string_view name, T M::*member) {
  return {name, member};
}

// Constant such as `uint8 ADD=0`: part of the text, not of the bytes and not of the type hash.
struct Constant {
  std::string_view type, name, value;
};

template <class M>
concept Message = requires {
  { M::kType } -> std::convertible_to<std::string_view>;
  M::members();
};

template <class M>
concept HasConstants = requires {
  M::kConstants;
};

template <class T>
concept Number = (std::is_arithmetic_v<T> && !std::is_same_v<T, bool>) || std::is_same_v<T, Byte>;

template <class T>
struct IsSequence : std::false_type {};
template <class T>
struct IsSequence<std::vector<T>> : std::true_type {};
template <class T>
concept Sequence = IsSequence<T>::value;

template <class T>
struct IsFixedArray : std::false_type {};
template <class T, std::size_t N>
struct IsFixedArray<std::array<T, N>> : std::true_type {};
template <class T>
concept FixedArray = IsFixedArray<T>::value;

// Calls f(const Field<M, T>&) for each field, in order.
template <Message M, class F>
constexpr void for_each_field(F&& f) {
  std::apply([&f](const auto&... fields) { (f(fields), ...); }, M::members());
}

}  // namespace pitwall::ros

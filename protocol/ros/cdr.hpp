// Codec of ROS 2 messages in plain CDR, XCDR version 1 with its header of four bytes, as in DDS
// and, under the encoding `cdr`, in Foxglove and MCAP.
//
//     00 01 00 00   little endian; values are aligned to their own size, counted from here on
//     string        u32 length with the NUL, characters, NUL
//     sequence      u32 count, elements         fixed array: elements
//     no fields     one zero byte
//   in     a message (protocol/ros/message.hpp), or bytes from any source, of either byte order
//   out    bytes, appended; or the message
//   errors encode: none. decode: a Problem with the field's name for another representation, an
//          end inside of a field, a length beyond the end, a string without NUL, a bool above 1,
//          more than three bytes after the end (the padding of RTPS)
//   cost   O(bytes); numbers are copied in one piece; a length never allocates more than the bytes
//          can hold; decode_into() allocates only where the message has no room
//   source OMG DDS-XTypes 1.3 section 7.4.1 (XCDR1), OMG DDSI-RTPS 2.5 section 10.2
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include <span>

#include "protocol/ros/message.hpp"
#include "protocol/vocabulary/result.hpp"

namespace pitwall::ros {

inline constexpr std::size_t kCdrHeader = 4;

class CdrWriter {
 public:
  // Appends to `out`; alignment counts from the end of the header that this writes.
  explicit CdrWriter(std::vector<std::uint8_t>& out);

  template <class T>
  void put(const T& value) {
    if constexpr (Message<T>) {
      put_message(value);
    } else if constexpr (Sequence<T>) {
      put(static_cast<std::uint32_t>(value.size()));
      put_all(value);
    } else if constexpr (FixedArray<T>) {
      put_all(value);
    } else if constexpr (Text<T>) {
      put_text(value);
    } else if constexpr (std::is_same_v<T, bool>) {
      out_.push_back(value ? 1 : 0);
    } else {
      static_assert(Number<T>);
      put_numbers(&value, 1, sizeof(T));
    }
  }

 private:
  template <class M>
  void put_message(const M& message) {
    if constexpr (std::tuple_size_v<decltype(M::members())> == 0) out_.push_back(0);
    for_each_field<M>([&](const auto& field) { put(message.*field.member); });
  }
  template <class Items>
  void put_all(const Items& items) {
    using Item = typename Items::value_type;
    if constexpr (Number<Item>) {
      if (!items.empty()) put_numbers(items.data(), items.size(), sizeof(Item));
    } else {
      for (const auto& item : items) put(item);
    }
  }
  void put_text(std::string_view text);
  void put_numbers(const void* numbers, std::size_t count, std::size_t bytes_each);

  std::vector<std::uint8_t>& out_;
  std::size_t begins_;
};

class CdrReader {
 public:
  explicit CdrReader(std::span<const std::uint8_t> bytes);

  template <class T>
  void take(T& value) {
    if constexpr (Message<T>) {
      take_message(value);
    } else if constexpr (Sequence<T>) {
      value.resize(take_count(least_bytes<typename T::value_type>()));
      take_all(value);
    } else if constexpr (FixedArray<T>) {
      take_all(value);
    } else if constexpr (Text<T>) {
      value = take_text();
      if constexpr (BoundedText<T>) {
        if (value.size() > T::kBound)
          refuse("expected at most " + std::to_string(T::kBound) + " bytes, found " +
                 std::to_string(value.size()));
      }
    } else if constexpr (std::is_same_v<T, bool>) {
      value = take_flag();
    } else {
      static_assert(Number<T>);
      take_numbers(&value, 1, sizeof(T));
    }
  }

  // Refuses anything but padding at the end.
  void finish();
  void refuse(std::string why);
  bool ok() const { return !problem_; }
  const Problem& problem() const { return *problem_; }

 private:
  // Smallest size of an element, without the padding of its fields.
  template <class T>
  static constexpr std::size_t least_bytes() {
    if constexpr (Number<T>) {
      return sizeof(T);
    } else if constexpr (Text<T> || Sequence<T>) {
      return sizeof(std::uint32_t);
    } else if constexpr (FixedArray<T>) {
      return std::tuple_size_v<T> * least_bytes<typename T::value_type>();
    } else if constexpr (Message<T>) {
      std::size_t sum = 0;
      for_each_field<T>([&sum]<class M, class F>(const Field<M, F>&) { sum += least_bytes<F>(); });
      return sum > 0 ? sum : 1;
    } else {
      return 1;
    }
  }
  template <class M>
  void take_message(M& message) {
    if constexpr (std::tuple_size_v<decltype(M::members())> == 0) (void)take_flag();
    for_each_field<M>([&](const auto& field) {
      const std::string_view outer = field_;
      field_ = field.name;
      take(message.*field.member);
      if (ok()) field_ = outer;
    });
  }
  template <class Items>
  void take_all(Items& items) {
    using Item = typename Items::value_type;
    if constexpr (Number<Item>) {
      if (!items.empty()) take_numbers(items.data(), items.size(), sizeof(Item));
    } else if constexpr (std::is_same_v<Item, bool>) {
      for (std::size_t i = 0; i < items.size(); ++i) items[i] = take_flag();
    } else {
      for (Item& item : items) {
        if (!ok()) return;
        take(item);
      }
    }
  }
  bool has(std::size_t bytes);
  bool align(std::size_t bytes);
  std::size_t take_count(std::size_t least_each);
  std::string_view take_text();  // of the bytes
  bool take_flag();
  void take_numbers(void* numbers, std::size_t count, std::size_t bytes_each);

  std::span<const std::uint8_t> bytes_;  // after the header
  std::size_t at_ = 0;
  bool swapped_ = false;
  std::string_view field_;
  std::optional<Problem> problem_;
};

template <Message M>
void encode(const M& message, std::vector<std::uint8_t>& out) {
  CdrWriter{out}.put(message);
}

// Into a message whose storage is used again: without allocation where it is large enough. After an
// error the message is anything.
template <Message M>
std::optional<Problem> decode_into(std::span<const std::uint8_t> bytes, M& message) {
  CdrReader reader{bytes};
  if (reader.ok()) reader.take(message);
  reader.finish();
  if (!reader.ok()) return reader.problem();
  return std::nullopt;
}

template <Message M>
Result<M, Problem> decode(std::span<const std::uint8_t> bytes) {
  M message;
  if (auto problem = decode_into(bytes, message)) return Unexpected{*std::move(problem)};
  return message;
}

}  // namespace pitwall::ros

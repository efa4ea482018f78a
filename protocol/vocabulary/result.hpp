// Result type: a value or an error. It has the interface of std::expected (C++23), which can
// replace it later. Access to the wrong side is a programming error (CHECK).
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <variant>

#include "protocol/vocabulary/check.hpp"

namespace pitwall {

template <class E>
struct Unexpected {
  E error;
};
template <class E>
Unexpected(E) -> Unexpected<E>;

template <class T, class E>
class [[nodiscard]] Result {
 public:
  Result(T value) : side_(std::in_place_index<0>, std::move(value)) {}  // NOLINT
  explicit Result(std::in_place_t) : side_(std::in_place_index<0>) {}   // T{}, built in place
  Result(Unexpected<E> reason)
      : side_(std::in_place_index<1>, std::move(reason.error)) {}  // NOLINT

  bool has_value() const { return side_.index() == 0; }
  explicit operator bool() const { return has_value(); }

  const T& value() const& { return CHECK(has_value()), std::get<0>(side_); }
  T& value() & { return CHECK(has_value()), std::get<0>(side_); }
  T&& value() && { return CHECK(has_value()), std::get<0>(std::move(side_)); }
  const T& operator*() const& { return value(); }
  T& operator*() & { return value(); }
  T&& operator*() && { return std::move(*this).value(); }
  const T* operator->() const { return &value(); }
  T* operator->() { return &value(); }
  const E& error() const { return CHECK(!has_value()), std::get<1>(side_); }
  T value_or(T fallback) const { return has_value() ? value() : fallback; }

 private:
  std::variant<T, E> side_;
};

// Error in an input that a person wrote, with its place: "cars/av21.yaml:12:3".
struct Problem {
  std::string place;
  std::string what;
};

inline Unexpected<Problem> refuse(std::string_view place, std::string_view what) {
  return Unexpected{Problem{std::string{place}, std::string{what}}};
}

inline std::string to_string(const Problem& p) { return p.place + ": error: " + p.what; }

}  // namespace pitwall

// Byte array for secrets: it is overwritten when it is destroyed.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace pitwall::telemetry {

// Overwrites with zeros; the compiler cannot optimise it away.
void wipe(std::span<std::uint8_t> bytes);

template <std::size_t N>
struct Secret {
  std::array<std::uint8_t, N> bytes{};

  Secret() = default;
  explicit Secret(const std::array<std::uint8_t, N>& value) : bytes(value) {}
  Secret(const Secret&) = default;
  Secret& operator=(const Secret&) = default;
  ~Secret() { wipe(bytes); }

  std::uint8_t* data() { return bytes.data(); }
  const std::uint8_t* data() const { return bytes.data(); }
  std::span<const std::uint8_t, N> span() const { return bytes; }
};

}  // namespace pitwall::telemetry

// Random sendable CAN frame. It uses the raw engine, whose sequence the C++ standard fixes.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <random>

#include "protocol/can/frame.hpp"

namespace pitwall::transport {

inline can::Frame any_frame(std::mt19937_64& random) {
  constexpr std::uint8_t kFdLengths[] = {0, 5, 8, 12, 16, 20, 24, 32, 48, 64};
  can::Frame f;
  f.extended = random() % 2 == 0;
  f.fd = random() % 3 == 0;
  f.remote = !f.fd && random() % 5 == 0;
  f.id = static_cast<std::uint32_t>(random()) &
         (f.extended ? can::kMaxExtendedId : can::kMaxStandardId);
  f.length = f.fd ? kFdLengths[random() % 10] : static_cast<std::uint8_t>(random() % 9);
  if (!f.remote)
    for (std::size_t i = 0; i < f.length; ++i) f.data[i] = static_cast<std::uint8_t>(random());
  return f;
}

}  // namespace pitwall::transport

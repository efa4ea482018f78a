// Encoding of the car's messages as frames, and decoding.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include "protocol/can/av21.hpp"

namespace pitwall::faults {

template <class M>
can::Frame frame_of(const M& message) {
  can::Frame frame;
  can::EncodeCounters counters;
  EXPECT_TRUE(can::av21::encode(message, frame, counters));
  return frame;
}

template <class M>
M decoded(const can::Frame& frame) {
  M message;
  EXPECT_TRUE(can::av21::decode(frame, message));
  return message;
}

}  // namespace pitwall::faults

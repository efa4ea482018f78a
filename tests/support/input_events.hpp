// Bytes of a Linux input device (struct input_event), event after event.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <linux/input.h>

#include <cstdint>
#include <cstring>
#include <vector>

namespace pitwall::testing {

struct InputBytes {
  std::vector<std::uint8_t> bytes;

  InputBytes& event(std::uint16_t type, std::uint16_t code, std::int32_t value) {
    input_event event{};
    event.type = type;
    event.code = code;
    event.value = value;
    const std::size_t at = bytes.size();
    bytes.resize(at + sizeof event);
    std::memcpy(bytes.data() + at, &event, sizeof event);
    return *this;
  }
  InputBytes& axis(std::uint16_t code, std::int32_t value) { return event(EV_ABS, code, value); }
  InputBytes& key(std::uint16_t code, std::int32_t value) { return event(EV_KEY, code, value); }
  InputBytes& report() { return event(EV_SYN, SYN_REPORT, 0); }
  InputBytes& dropped() { return event(EV_SYN, SYN_DROPPED, 0); }
};

}  // namespace pitwall::testing

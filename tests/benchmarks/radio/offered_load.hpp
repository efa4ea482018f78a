// Bulk load offered to the car's end, a multiple of the link rate: an object every 50 ms, of at
// most kBulkObject bytes; the newest one replaces the others.
//   in     the rate of the link; the multiple of it to offer, 0: nothing
//   units  bytes per second
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "tests/benchmarks/radio/virtual_radio.hpp"

namespace pitwall::radio {

class OfferedLoad {
 public:
  OfferedLoad(double rate_bytes_per_s, double multiple);

  void run(VirtualRadio& radio, Duration length);

 private:
  std::vector<std::uint8_t> object_;
};

}  // namespace pitwall::radio

// Bulk offered to the car's end, so much more than the link carries: objects of 50 ms each, the
// newest wins.
//   in     the rate of the link, and how many times that is offered; 0: nothing
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

// Looks at one car's stand once a second, for /metrics.
//   in     the station, the wall where there are consoles, the other outlets of this stand
//   out    a CarSight on the board; the counters of the web server
//   cost   some ten microseconds a second; the text is made by who asks for it
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "basestation/outlets/metrics/board.hpp"
#include "basestation/outlets/outlet.hpp"
#include "basestation/outlets/wall/wall.hpp"

namespace pitwall::outlets::metrics {

// What it looks at; all of it outlives the outlet.
struct Stand {
  std::size_t place = 0;  // of the car among those of this base
  int car = 0;
  std::string name;
  const wall::Wall* wall = nullptr;
  const web::WebServer* server = nullptr;
  std::vector<const Outlet*> outlets{};
};

class MetricsOutlet : public Outlet {
 public:
  static constexpr Duration kEvery = seconds(1);

  MetricsOutlet(Board& board, Stand stand) : board_(board), stand_(std::move(stand)) {}

  void watch(const Outlet& outlet) { stand_.outlets.push_back(&outlet); }
  void packet(const intake::Station&, const telemetry::Arrival&) override {}
  void serve(intake::Station& station, Instant now) override;
  Instant due() const override { return due_; }

 private:
  Board& board_;
  Stand stand_;
  Instant due_{};
};

CarSight sight_of(const intake::Station& station, const Stand& stand, Instant now);

}  // namespace pitwall::outlets::metrics

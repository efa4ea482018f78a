// List of the cars that this base serves: the document /api/cars, from which a console gets the
// numbers of the cars.
//   in     number, name, mode and link of each car
//   out    {"cars": [{"number", "name", "mode", "link"}]}, in the order of their tabs; link is null
//          if it is empty
//   invariants
//          published again when one of them changes
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "basestation/publishers/web/web_server.hpp"
#include "basestation/service/publisher.hpp"

namespace pitwall::session {

inline constexpr const char* kRosterPath = "/api/cars";

struct CarStatus {
  int number = 0;
  std::string name{}, mode = "NONE", link{};
};

std::string roster_text(const std::vector<CarStatus>& cars);

// Checks for changes twice a second.
class Roster : public service::LoopTask {
 public:
  using ReadStatus = std::function<std::vector<CarStatus>()>;

  Roster(publishers::web::WebServer& server, ReadStatus read_status)
      : server_(server), read_status_(std::move(read_status)) {}

  void serve(Instant now) override;
  Instant due() const override { return due_; }

 private:
  static constexpr Duration kEvery = milliseconds(500);

  publishers::web::WebServer& server_;
  ReadStatus read_status_;
  std::string reported_;
  Instant due_{};
};

}  // namespace pitwall::session

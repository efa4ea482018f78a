// Hub process for a bus `unix:PATH` that has no hub yet. A child process, so that its timing does
// not depend on the bench. It ends with its owner, however the owner ends.
//   in     name of the bus (other interfaces need no hub); file of bench time, empty: the wall
//          clock
//   out    nullopt if no hub is needed; else a hub that already accepts clients
//   errors Problem: it did not start (its own messages are on stderr)
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <utility>

#include "protocol/transport/process.hpp"
#include "protocol/vocabulary/result.hpp"

namespace pitwall::can_bus {

class OwnHub {
 public:
  // `program` is pitwall-hil.
  static Result<std::optional<OwnHub>, Problem> start(const std::string& program,
                                                      const std::string& bus,
                                                      const std::string& clock = {});
  OwnHub(OwnHub&&) = default;
  OwnHub& operator=(OwnHub&&) = delete;
  ~OwnHub();  // the hub prints its counters and removes its path

 private:
  explicit OwnHub(transport::Process process) : process_(std::move(process)) {}
  transport::Process process_;
};

}  // namespace pitwall::can_bus

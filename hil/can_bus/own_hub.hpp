// A hub of our own for a bus `unix:PATH` that nobody serves yet: a child process, so that it keeps
// its own pace beside the bench. It goes with its owner, however that ends.
//   in     name of the bus; another interface needs no hub. File of bench time; empty: the wall's
//   out    nothing where none is needed; else a hub that takes clients already
//   errors Problem: it did not start (its own words are on stderr)
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
  ~OwnHub();  // it prints its counters and removes its path

 private:
  explicit OwnHub(transport::Process process) : process_(std::move(process)) {}
  transport::Process process_;
};

}  // namespace pitwall::can_bus

// Interface of what the event loop serves beside a car's service: consoles, the recorder and other
// publishers. A publisher never waits.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "basestation/service/car_service.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::service {

// What a publisher with readers elsewhere has done since it began.
struct PublisherFigures {
  using Counts = std::vector<std::pair<std::string, std::uint64_t>>;

  std::string publisher;        // "lcm"
  std::uint64_t sent = 0;       // messages
  std::uint64_t failed = 0;     // that the network did not take
  std::uint64_t clients = 0;    // there now, where they are known
  Counts dropped{}, refused{};  // by channel; by what was asked
};

class Publisher {
 public:
  virtual ~Publisher() = default;
  // Each packet of the car that was not had before, as soon as the service has it.
  virtual void packet(const CarService& /*car*/, const telemetry::Arrival& /*arrival*/) {}
  // At each wake-up of the loop: what its people ask for, before the service goes on ...
  virtual void submit(CarService& /*car*/, Instant /*now*/) {}
  // ... and afterwards what there is to publish.
  virtual void publish(const CarService& car, Instant now) = 0;
  virtual Instant due() const = 0;       // to be served then, if not before
  virtual int fd() const { return -1; }  // to be served when it is readable
  virtual std::optional<PublisherFigures> figures() const { return std::nullopt; }
};

// Of all cars together: a screen, the list of cars.
class LoopTask {
 public:
  virtual ~LoopTask() = default;
  virtual void serve(Instant now) = 0;  // at each wake-up
  virtual void finish(Instant /*now*/) {}
  virtual Instant due() const = 0;
};

}  // namespace pitwall::service

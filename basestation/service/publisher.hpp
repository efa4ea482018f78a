// Interface of a publisher, which the event loop serves beside a car's service: consoles, the
// recorder and others. A publisher never waits.
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

// Counters of a publisher with external readers, since its start.
struct PublisherFigures {
  using Counts = std::vector<std::pair<std::string, std::uint64_t>>;

  std::string publisher;        // "lcm"
  std::uint64_t sent = 0;       // messages
  std::uint64_t failed = 0;     // messages that the network did not accept
  std::uint64_t clients = 0;    // connected now, if they are known
  Counts dropped{}, refused{};  // by channel; by kind of request
};

class Publisher {
 public:
  virtual ~Publisher() = default;
  // Called for each new packet of the car, as soon as the service has it.
  virtual void packet(const CarService& /*car*/, const telemetry::Arrival& /*arrival*/) {}
  // Called at each wake-up of the loop: passes on requests of its clients ...
  virtual void submit(CarService& /*car*/, Instant /*now*/) {}
  // ... and, after the service has advanced, publishes.
  virtual void publish(const CarService& car, Instant now) = 0;
  virtual Instant due() const = 0;       // time of the next call, if no other event comes before
  virtual int fd() const { return -1; }  // call it when this is readable
  virtual std::optional<PublisherFigures> figures() const { return std::nullopt; }
};

// Task of all cars together: a screen, the list of cars.
class LoopTask {
 public:
  virtual ~LoopTask() = default;
  virtual void serve(Instant now) = 0;  // at each wake-up
  virtual void finish(Instant /*now*/) {}
  virtual Instant due() const = 0;
};

}  // namespace pitwall::service

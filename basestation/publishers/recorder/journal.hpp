// Adapter from a car's service to a Recorder: states, and the recorder's own figures.
//   in     packets as they come; the time
//   out    every group of each packet; figures of the recorder once a second
//   cost   a copy for each record
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include "basestation/service/publisher.hpp"
#include "protocol/recorder/recorder.hpp"

namespace pitwall::recorder {

class Journal : public service::Publisher {
 public:
  static constexpr Duration kFiguresEvery = seconds(1);

  explicit Journal(Recorder& recorder) : recorder_(recorder) {}

  void packet(const service::CarService& car, const telemetry::Arrival& arrival) override;
  void publish(const service::CarService& car, Instant now) override;
  Instant due() const override { return figures_at_; }

 private:
  Recorder& recorder_;
  Instant figures_at_{};
};

// Observer that records the datagrams of both directions of a Station.
link::Station::Observer observer_of_datagrams(Recorder& recorder);

// Observer that records the samples of a JoystickDevice.
std::function<void(const telemetry::JoystickSample&, Instant)> observer_of_joystick(
    Recorder& recorder);

}  // namespace pitwall::recorder

// I/O of the car process: CAN socket and ports of the receivers. read() is called before the step,
// write() after it. The radio is in radio.hpp.
//   in     Arguments; the receivers of the car file
//   out    what arrived since the last read(); counters
//   errors open(): Problem that names the interface or the link; afterwards counters only
//   cost   no allocation after open()
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "protocol/can/frame.hpp"
#include "protocol/transport/can/can_socket.hpp"
#include "protocol/vocabulary/result.hpp"
#include "vehicle/io/arguments/arguments.hpp"
#include "vehicle/io/black_box.hpp"
#include "vehicle/io/bus_watch.hpp"
#include "vehicle/io/link_observer.hpp"
#include "vehicle/io/receiver_port.hpp"
#include "vehicle/io/transmit_slots.hpp"
#include "vehicle/world/sensor_input.hpp"

namespace pitwall::io {

class CarIo {
 public:
  static Result<CarIo, Problem> open(const Arguments& args, const world::Receivers& receivers = {});

  struct Received {
    std::span<const can::ReceivedFrame> can;  // valid until the next read()
    world::SensorInput sensors;
    world::LinkObservation link;
    std::array<std::optional<Instant>, world::kGnssUnits> gnss_byte_at;  // newest byte, if any
  };
  // Every byte of the receivers is recorded in `box`.
  Received read(BlackBox& box);
  // Sends the frames of this tick, in order of urgency. Frames that cannot be sent in time are
  // dropped and counted; on a listen-only interface these are all.
  void write(std::span<const can::Frame> frames, Instant now);
  // Requests a restart of the controller, which is executed outside the loop.
  void restart_bus() { watch_->restart(); }

  const transport::CanSocketCounters& can() const { return can_.counters(); }
  std::span<const ReceiverPort> receivers() const { return receivers_; }
  const TransmitCounters& transmit() const { return slots_.counters(); }
  // Frames that were not sent in time: a command is never sent late.
  std::uint64_t tx_drops() const { return slots_.counters().dropped() + listen_only_drops_; }
  void poll_drops() { can_.poll_drops(); }
  const BusReport& bus() { return watch_->newest(); }
  // Reason for which the kernel refused a request to the bus; returned once, at the first refusal.
  const char* fresh_refusal();
  // The interface is listen-only: nothing is ever sent, and the car must not be armed.
  bool listen_only() { return bus().interface.listen_only; }

 private:
  CarIo(transport::CanSocket can, std::unique_ptr<BusWatch> watch,
        std::vector<ReceiverPort> receivers);
  void poll_bus(Instant now);

  transport::CanSocket can_;
  std::unique_ptr<BusWatch> watch_;
  TransmitSlots slots_;
  LinkObserver observer_;
  world::LinkObservation link_;
  bool refusal_reported_ = false;
  std::uint64_t emptied_ = 0;  // flushes of the kernel's queue at the last observation
  std::vector<ReceiverPort> receivers_;
  std::vector<can::ReceivedFrame> frames_;
  std::uint64_t listen_only_drops_ = 0;  // frames not sent on a listen-only interface
};

}  // namespace pitwall::io

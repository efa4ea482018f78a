// Encoder of the command of one tick into CAN frames. It does not check the command:
// safety/frame_gate checks the frames. To be called once per 10 ms tick.
//   in     the command chosen by the supervisor, the CT state, the flags that the autonomy acted
//          on, accelerations
//   out    up to 8 frames: brake 1400 first, throttle 1401, steering 1402, gear 1403, then
//          ct_report 1404, ct_report_2 1405, dash switches 1406, accelerations 1450
//   units  road-wheel angle in rad -> motor degrees (x ratio); fractions -> %; m/s^2 -> g
//   errors a number that is not finite gives no frame and is counted in not_finite; a number that
//          the field cannot hold saturates and is counted in saturated (the gate then refuses it)
// Each message is sent at its period of the database's side file, rounded to ticks. Every counter
// changes in every frame of its message; ct_state_rolling_counter runs 0..9.
// The acknowledgements return the raw flags of the RaceControl that this tick's plan was made with:
// they mean "acted on by the autonomy", not "received by a driver".
// Bus load with all eight at 100 Hz: 108 kbit/s with worst-case stuffing, 22 % of 500 kbit/s.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <type_traits>

#include "protocol/can/encode.hpp"
#include "protocol/can/frame.hpp"
#include "protocol/vocabulary/fixed_vector.hpp"
#include "protocol/vocabulary/time.hpp"
#include "vehicle/world/actuator_command.hpp"
#include "vehicle/world/ego_state.hpp"
#include "vehicle/world/legal_range.hpp"
#include "vehicle/world/mode.hpp"
#include "vehicle/world/race_control.hpp"

namespace pitwall::gateway {

inline constexpr std::size_t kOutboundFrames = 8;
inline constexpr std::uint8_t kReportCounterEnd = 10;  // ct_state_rolling_counter runs 0..9

struct OutboundParams {
  double steering_ratio = 19.5;       // motor angle : road-wheel angle
  std::uint8_t vehicle_number = 255;  // ct_report.veh_num; [0, 255], 255 not assigned
  std::uint8_t traction_aim = 0;      // dash switch, 0 off, 1 least .. 4 most; [0, 4]
  std::uint8_t traction_range = 0;    // [0, 4]
  Duration tick = milliseconds(10);   // period of the calls; [5, 20] ms
};

inline constexpr auto kOutboundRanges = std::to_array<world::NamedRange<OutboundParams>>({
    {"steering_ratio", &OutboundParams::steering_ratio, world::kSteeringRatio.least,
     world::kSteeringRatio.most},
});

struct OutboundState {
  std::array<Instant, kOutboundFrames> due{};
  std::uint8_t brake_counter = 0, throttle_counter = 0, steering_counter = 0, report_counter = 0;
  can::EncodeCounters refused;
};
static_assert(std::is_trivially_copyable_v<OutboundState>);

struct OutboundInputs {
  world::ActuatorCommand command;  // from the supervisor
  bool actuate = false;            // armed: actuator frames are sent
  world::CtState ct_state = world::CtState::kDefault;
  world::RaceControl acted_on;  // flags that the plan was made with
  world::EgoState ego;          // accelerations; vertical is sent as 1 g
};

struct OutboundOutput {
  FixedVector<can::Frame, kOutboundFrames> frames;
  can::EncodeCounters counters;  // since the start
};

OutboundOutput encode(const OutboundParams& params, OutboundState& state,
                      const OutboundInputs& inputs, Instant now);

}  // namespace pitwall::gateway

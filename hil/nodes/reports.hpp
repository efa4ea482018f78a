// Scheduler and encoder of the drive-by-wire's reports.
//   in     Feedback, the state to report, now
//   out    the frames that are due
//   invariants
//          message k is due at phase_k + i * period_k on the bench's clock for every integer i;
//          phases differ, so that no two messages of one period are due in the same millisecond
//   errors a message with a NaN is left out and counted; a signal out of range saturates and is
//          counted
//   source cycle times: the override file of the public AV-24 bridge ("mirrors the race car
//          network")
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "hil/nodes/feedback.hpp"
#include "protocol/can/frame.hpp"
#include "protocol/vocabulary/fixed_vector.hpp"
#include "protocol/vocabulary/time.hpp"
#include "vehicle/world/signals.hpp"

namespace pitwall::drive_by_wire {

struct ReportRow {
  std::uint32_t id;
  Duration period, phase;
};

// misc_report (1304) takes its period from the parameters.
inline constexpr std::array kReports{
    ReportRow{1300, milliseconds(5), milliseconds(0)},
    ReportRow{1301, milliseconds(10), milliseconds(1)},
    ReportRow{1302, milliseconds(10), milliseconds(2)},
    ReportRow{1303, milliseconds(10), milliseconds(3)},
    ReportRow{1340, milliseconds(10), milliseconds(4)},
    ReportRow{1341, milliseconds(10), milliseconds(6)},
    ReportRow{1343, milliseconds(10), milliseconds(7)},
    ReportRow{1310, milliseconds(100), milliseconds(8)},
    ReportRow{1311, milliseconds(100), milliseconds(18)},
    ReportRow{1312, milliseconds(100), milliseconds(28)},
    ReportRow{1320, milliseconds(100), milliseconds(38)},
    ReportRow{1321, milliseconds(100), milliseconds(48)},
    ReportRow{1322, milliseconds(100), milliseconds(58)},
    ReportRow{1323, milliseconds(100), milliseconds(68)},
    ReportRow{1342, milliseconds(100), milliseconds(78)},
    ReportRow{1304, milliseconds(500), milliseconds(9)},
    ReportRow{1324, milliseconds(1000), milliseconds(19)},
    ReportRow{1325, milliseconds(1000), milliseconds(79)},
    ReportRow{1326, milliseconds(1000), milliseconds(139)},
    ReportRow{1327, milliseconds(1000), milliseconds(199)},
    ReportRow{1328, milliseconds(1000), milliseconds(259)},
    ReportRow{1329, milliseconds(1000), milliseconds(319)},
    ReportRow{1330, milliseconds(1000), milliseconds(379)},
    ReportRow{1331, milliseconds(1000), milliseconds(439)},
    ReportRow{1332, milliseconds(1000), milliseconds(489)},
    ReportRow{1333, milliseconds(1000), milliseconds(549)},
    ReportRow{1334, milliseconds(1000), milliseconds(619)},
    ReportRow{1335, milliseconds(1000), milliseconds(679)},
    ReportRow{1336, milliseconds(1000), milliseconds(739)},
    ReportRow{1337, milliseconds(1000), milliseconds(799)},
    ReportRow{1338, milliseconds(1000), milliseconds(859)},
    ReportRow{1339, milliseconds(1000), milliseconds(919)},
};

using ReportFrames = FixedVector<can::Frame, kReports.size()>;

// True means a fault, as in diagnostic_report.
struct Diagnostics {
  bool front_brake_out_of_spec = false, rear_brake_out_of_spec = false, low_engine_speed = false;
  bool steer_warning = false, emergency_brake = false;
  bool computer_heartbeat_lost = false, race_control_lost = false;
};

struct ReportState {
  bool begun = false;
  std::array<Instant, kReports.size()> due{};
  std::uint8_t brake_counter = 0, throttle_counter = 0, steering_counter = 0, misc_counter = 0;
  std::uint64_t skipped = 0, unsent = 0, saturated = 0;
};

struct ReportInputs {
  Feedback feedback;
  Diagnostics diagnostics;
  world::SysState system = world::SysState::kPowerOn;
  bool engine_switch = false;
  Duration misc_period = milliseconds(500);
};

ReportFrames due_reports(ReportState& state, const ReportInputs& in, Instant now);

// Encodes one report now, independent of its period; counters advance. Returns false if a number is
// not finite.
bool encode_report(std::uint32_t id, ReportState& state, const ReportInputs& in, can::Frame& out);

}  // namespace pitwall::drive_by_wire

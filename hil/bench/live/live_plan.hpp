// Plan of a live run: programs, ports, files; and the command of each process.
//   in     LivePlan
//   out    argv per role, for the start and for a restart after a kill. Only the first start of the
//          car is armed
//          in_bay(): the same plan for another bay of this machine
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "hil/bench/live/process_supervisor.hpp"
#include "hil/bench/live/radio_path.hpp"
#include "hil/bench/live/station_cars.hpp"
#include "hil/bench/progress.hpp"
#include "hil/scenario/radio_section.hpp"
#include "protocol/recording/mcap_writer.hpp"
#include "protocol/vocabulary/result.hpp"

namespace pitwall::bench {

// Ports of the bench's machine for the car's radio, its second path and its local report.
inline constexpr std::uint16_t kRadioListenPort = 23'430, kSecondListenPort = 23'435,
                               kReportPort = 23'436;

struct LivePlan {
  std::string interface = "vcan0";
  // Program and arguments, without those that the bench adds. An empty `vehicle`: the car runs
  // already, and the bench attaches to its bus, its receivers' ports and its radio.
  std::vector<std::string> vehicle{}, guardian{}, base{};
  std::string folder{};                       // for the summaries and the candump
  std::string sensors{};                      // sensor file of the car; empty: none
  int sensors_domain = 0;                     // ROS domain of these sensors
  std::string disk{};                         // for a disk-full fault; empty: none
  std::string clock{};                        // file of bench time; empty: the wall clock
  std::string clock_line{};                   // of a guest, to a host that follows it; empty: none
  std::string guardian_name{};                // of the memory that car and guardian share
  std::uint16_t gnss_port = 23'501;           // of unit 0; unit 1 is the next one
  std::uint16_t guardian_gnss_port = 23'503;  // likewise, of the guardian
  std::uint16_t base_port = 23'433;           // where the bench's own base station listens
  std::uint16_t second_base_port = 23'434;    // likewise, for the second path
  std::uint16_t report_port = kReportPort;    // receives the car's local report
  std::array<RadioPorts, scenario::kMaxPaths> radio{
      {{.listen = kRadioListenPort, .onward = 0, .uplink = 0},
       {.listen = kSecondListenPort, .onward = 0, .uplink = 0}}};
  std::size_t paths = 1;      // of the radio
  bool has_operator = false;  // the scenario has commands for the bench's own base station
  std::string cars_file{};    // of a base station that serves several cars; empty: this one alone
  std::string keys{};         // folder of car.keys and base.keys
  bool candump = false;       // record the bus with can-utils' candump
  recording::Sink log{};
  Follow follow{};  // called after every tick, when it has been judged

  bool attached() const { return vehicle.empty(); }
  // Of the bench's own base station.
  std::string command_socket() const { return folder + "/commands"; }
  std::vector<std::uint16_t> receiver_ports() const {  // of each unit 0
    std::vector<std::uint16_t> ports{gnss_port};
    if (!guardian.empty()) ports.push_back(guardian_gnss_port);
    return ports;
  }
  // True if the car has a base station: the bench's own, or an external one beyond `onward`.
  bool has_base() const { return !base.empty() || radio[0].onward != 0; }
  // Summary file of car or guardian: on the disk of the disk-full fault, if there is one.
  std::string summary_of(const std::string& who) const {
    return (disk.empty() ? folder : disk) + "/" + who + ".json";
  }
};

// The car has the sensors of this file; an empty name: none.
std::optional<Problem> add_sensors(LivePlan& plan, const std::string& file);

std::array<Member, kRoles> members_of(const LivePlan& plan);

// This car at the bench's own base station; without number and name.
StationCar station_car_of(const LivePlan& plan);

// Several benches on one machine: each has a bay with its own ports and shared memory.
inline constexpr int kBayPorts = 200;  // offset of the ports from one bay to the next
inline constexpr int kBaysMax = 4;
LivePlan in_bay(LivePlan plan, int bay);

}  // namespace pitwall::bench

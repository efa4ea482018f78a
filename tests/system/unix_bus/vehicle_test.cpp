// The unmodified car on a hub that is killed, and on the one that comes after it.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "protocol/telemetry/state_packet.hpp"
#include "protocol/transport/can_socket.hpp"
#include "protocol/transport/clock.hpp"
#include "protocol/transport/file.hpp"
#include "protocol/transport/process.hpp"
#include "protocol/transport/udp_socket.hpp"
#include "tests/support/comes_true.hpp"

namespace pitwall {
namespace {

using telemetry::field;
using testing::comes_true;
using transport::Process;

const std::string kRoot = PITWALL_SOURCE_DIR;
constexpr double kUnknown = 0, kDown = 5;  // codes of bus.controller

std::string program(const char* name, const char* fallback) {
  const char* path = std::getenv(name);
  return path == nullptr ? kRoot + fallback : path;
}

class VehicleOnUnixBus : public ::testing::Test {
 protected:
  void SetUp() override {
    auto folder = transport::TemporaryFolder::create("pitwall-unix-vehicle-");
    ASSERT_TRUE(folder) << to_string(folder.error());
    folder_.emplace(*std::move(folder));
    auto report = transport::UdpSocket::bind({.ip = transport::kLoopbackIp, .port = 0});
    ASSERT_TRUE(report) << to_string(report.error());
    report_.emplace(*std::move(report));
  }

  std::string bus() const { return "unix:" + folder_->path() + "/bus"; }
  std::string said() const { return transport::read_file(folder_->path() + "/said").value_or(""); }

  Process spawn(const std::vector<std::string>& argv) {
    auto words = transport::AppendWriter::open(folder_->path() + "/said",
                                               transport::AppendWriter::Start::kAppend);
    auto process =
        Process::spawn({.argv = argv, .descriptors = {{words->fd(), 1}, {words->fd(), 2}}});
    EXPECT_TRUE(process) << to_string(process.error());
    return *std::move(process);
  }
  // Takes clients when it returns.
  Process start_hub(std::vector<std::string> more = {}) {
    std::vector<std::string> argv{
        program("PITWALL_BENCH_PROGRAM", "/build/release/hil/pitwall-hil"), "bus", "hub", bus()};
    argv.insert(argv.end(), more.begin(), more.end());
    Process out = spawn(argv);
    EXPECT_TRUE(comes_true([&] { return transport::CanSocket::open(bus()).has_value(); }))
        << said();
    return out;
  }
  Process start_vehicle() {
    return spawn({program("PITWALL_VEHICLE_PROGRAM", "/build/release/vehicle/pitwall-vehicle"),
                  "--car", kRoot + "/vehicle/config/cars/av21.yaml", "--track",
                  kRoot + "/vehicle/config/tracks/lvms.yaml", "--can", bus(), "--gnss",
                  "23511,23512", "--local-report", std::to_string(report_->local().port),
                  "--summary", folder_->path() + "/summary.json", "--simulation", "--no-base"});
  }

  // The next packet of the car for which the condition holds.
  template <class Condition>
  bool report_says(Condition&& condition) {
    return comes_true([&] {
      std::vector<transport::UdpDatagram> datagrams(8);
      const std::size_t count = report_->receive(datagrams);
      for (std::size_t i = 0; i < count; ++i) {
        const auto packet = telemetry::parse(datagrams[i].payload());
        if (packet && condition(packet->values)) return true;
      }
      return false;
    });
  }
  bool controller_is(double state) {
    return report_says(
        [state](const telemetry::Values& v) { return v[field("bus.controller")] == state; });
  }

  std::optional<transport::TemporaryFolder> folder_;
  std::optional<transport::UdpSocket> report_;
};

// Frames of the car on the bus as somebody hears it who joins now.
bool car_is_heard(const std::string& bus) {
  auto socket = transport::CanSocket::open(bus);
  if (!socket) return false;
  std::vector<can::ReceivedFrame> frames(64);
  return comes_true([&] { return socket->receive(frames) > 0; });
}

TEST_F(VehicleOnUnixBus, SeesItsHubDieAndSpeaksToTheNextOne) {
  std::optional<Process> hub = start_hub();
  Process vehicle = start_vehicle();
  EXPECT_TRUE(car_is_heard(bus())) << said();
  EXPECT_TRUE(controller_is(kUnknown)) << said();  // up, and no controller that could tell
  hub->kill(SIGKILL);
  hub->wait();
  EXPECT_TRUE(controller_is(kDown)) << said();
  EXPECT_TRUE(std::filesystem::exists(folder_->path() + "/bus"));  // stale, and no obstacle
  hub.emplace(start_hub());
  EXPECT_TRUE(car_is_heard(bus())) << said();
  EXPECT_TRUE(controller_is(kUnknown)) << said();
  vehicle.kill(SIGTERM);
  EXPECT_EQ(vehicle.wait().code, 0) << said();
  EXPECT_TRUE(std::filesystem::exists(folder_->path() + "/summary.json"));
  hub->kill(SIGTERM);
  EXPECT_EQ(hub->wait().code, 0);
  EXPECT_NE(said().find("frames relayed"), std::string::npos) << said();
  EXPECT_FALSE(std::filesystem::exists(folder_->path() + "/bus"));
}

TEST_F(VehicleOnUnixBus, WithoutAHubTheCarDoesNotStartAndSaysWhere) {
  Process vehicle = start_vehicle();
  EXPECT_NE(vehicle.wait().code, 0);
  EXPECT_NE(said().find(bus() + ": error: nobody serves this bus"), std::string::npos) << said();
}

TEST_F(VehicleOnUnixBus, AHubEndsByItselfAfterItsTimeAndASecondOneIsRefused) {
  Process hub = start_hub({"--seconds", "0.5"});
  Process second = spawn(
      {program("PITWALL_BENCH_PROGRAM", "/build/release/hil/pitwall-hil"), "bus", "hub", bus()});
  EXPECT_EQ(second.wait().code, 2);
  EXPECT_NE(said().find(bus() + ": error: in use"), std::string::npos) << said();
  EXPECT_EQ(hub.wait().code, 0);
}

}  // namespace
}  // namespace pitwall

// The unmodified car and bench programs on an interface whose controller a test plays.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "protocol/telemetry/state_packet.hpp"
#include "protocol/transport/can/can_interface.hpp"
#include "protocol/transport/clock.hpp"
#include "protocol/transport/file.hpp"
#include "protocol/transport/process.hpp"
#include "protocol/transport/udp_socket.hpp"
#include "tests/system/slcan/scripted_controller.hpp"

namespace pitwall::slcan {
namespace {

using telemetry::field;
using transport::Process;

const std::string kRoot = PITWALL_SOURCE_DIR;
constexpr double kActive = 1, kBusOff = 4;  // codes of bus.controller

std::string program(const char* name, const char* fallback) {
  const char* path = std::getenv(name);
  return path == nullptr ? kRoot + fallback : path;
}

class Vehicle : public ::testing::Test {
 protected:
  void SetUp() override {
    auto opened = ScriptedController::open();
    ASSERT_TRUE(opened) << to_string(opened.error());
    controller_ = *std::move(opened);
    auto folder = transport::TemporaryFolder::create("pitwall-slcan-");
    ASSERT_TRUE(folder) << to_string(folder.error());
    folder_.emplace(*std::move(folder));
    auto report = transport::UdpSocket::bind({.ip = kLoopbackIp, .port = 0});
    ASSERT_TRUE(report) << to_string(report.error());
    report_.emplace(*std::move(report));
  }

  std::string output() const {
    return transport::read_file(folder_->path() + "/said").value_or("");
  }
  std::string summary() const {
    return transport::read_file(folder_->path() + "/summary.json").value_or("");
  }

  std::optional<Process> spawn(std::vector<std::string> argv) {
    auto errors = transport::AppendWriter::open(folder_->path() + "/said",
                                                transport::AppendWriter::Start::kTruncate);
    auto process = Process::spawn(
        {.argv = std::move(argv), .descriptors = {{errors->fd(), 1}, {errors->fd(), 2}}});
    EXPECT_TRUE(process) << to_string(process.error());
    if (!process) return std::nullopt;
    return *std::move(process);
  }
  std::optional<Process> start_vehicle(std::vector<std::string> argv = {}) {
    argv.insert(
        argv.end(),
        {program("PITWALL_VEHICLE_PROGRAM", "/build/release/vehicle/pitwall-vehicle"), "--car",
         kRoot + "/vehicle/config/cars/av21.yaml", "--track",
         kRoot + "/vehicle/config/tracks/" + track_, "--can", controller_->interface(), "--gnss",
         "23501,23502", "--local-report", std::to_string(report_->local().port), "--summary",
         folder_->path() + "/summary.json", "--simulation", "--arm", "--no-base"});
    return spawn(std::move(argv));
  }
  int bus(std::vector<std::string> words) {
    words.insert(words.begin(),
                 {program("PITWALL_BUS_PROGRAM", "/build/release/hil/pitwall-hil"), "bus"});
    auto process = spawn(std::move(words));
    return process ? process->wait().shell_code() : -1;
  }

  // Reads telemetry until the condition holds.
  template <class Condition>
  bool report_says(Condition&& condition) {
    const Instant limit = transport::monotonic_now() + seconds(30);
    while (transport::monotonic_now() < limit) {
      std::vector<transport::UdpDatagram> datagrams(8);
      const std::size_t count = report_->receive(datagrams);
      for (std::size_t i = 0; i < count; ++i) {
        const auto packet = telemetry::parse(datagrams[i].payload());
        if (packet && condition(packet->values)) return true;
      }
      transport::sleep_until(transport::monotonic_now() + milliseconds(5));
    }
    return false;
  }

  std::unique_ptr<ScriptedController> controller_;
  std::optional<transport::TemporaryFolder> folder_;
  std::optional<transport::UdpSocket> report_;
  std::string track_ = "ims.yaml";
};

TEST_F(Vehicle, ReportsBusOffRestartsThreeTimesAndStops) {
  ASSERT_EQ(bus({"up", controller_->interface(), "--bitrate", "500000"}), 0) << output();
  auto vehicle = start_vehicle();
  ASSERT_TRUE(vehicle);
  ASSERT_TRUE(report_says([](const telemetry::Values& values) {
    return values[field("bus.controller")] == kActive;
  })) << output();
  controller_->answer_open("sb256000\r");
  controller_->say("sb256000\r");
  EXPECT_TRUE(report_says(
      [](const telemetry::Values& values) { return values[field("bus.controller")] == kBusOff; }));
  const std::size_t opened = controller_->opened();
  const Instant limit = transport::monotonic_now() + seconds(20);
  while (controller_->opened() < opened + 3 && transport::monotonic_now() < limit)
    transport::sleep_until(transport::monotonic_now() + milliseconds(5));
  transport::sleep_until(transport::monotonic_now() + seconds(1));
  EXPECT_EQ(controller_->opened(), opened + 3);  // and none in the second after
  EXPECT_TRUE(report_says(
      [](const telemetry::Values& values) { return values[field("bus.controller")] == kBusOff; }));
  vehicle->kill(SIGTERM);
  EXPECT_EQ(vehicle->wait().code, 0) << output();
  EXPECT_NE(summary().find("\"controller\": \"bus_off\""), std::string::npos)
      << summary().substr(0, 1'500);
  EXPECT_NE(summary().find("\"restarts\": 3"), std::string::npos) << summary().substr(0, 1'500);
}

TEST_F(Vehicle, WithoutThePrivilegeToRestartSaysWhyAndLeavesTheBus) {
  ASSERT_EQ(bus({"up", controller_->interface(), "--bitrate", "500000"}), 0) << output();
  auto vehicle = start_vehicle({"setpriv", "--bounding-set", "-net_admin"});
  ASSERT_TRUE(vehicle);
  ASSERT_TRUE(report_says([](const telemetry::Values& values) {
    return values[field("bus.controller")] == kActive;
  })) << output();
  controller_->say("sb256000\r");
  EXPECT_TRUE(report_says([&](const telemetry::Values&) {
    return output().find("CAP_NET_ADMIN") != std::string::npos;
  })) << output();
  transport::sleep_until(transport::monotonic_now() + seconds(1));
  EXPECT_TRUE(report_says(
      [](const telemetry::Values& values) { return values[field("bus.controller")] == kBusOff; }));
  EXPECT_EQ(controller_->opened(), 1u);
}

TEST_F(Vehicle, OnAnInterfaceThatOnlyListensSaysSoAndStaysSilent) {
  ASSERT_EQ(bus({"up", controller_->interface(), "--bitrate", "500000", "--listen-only"}), 0)
      << output();
  auto vehicle = start_vehicle();
  ASSERT_TRUE(vehicle);
  double sent = -1, drops = 0, mode = -1;
  ASSERT_TRUE(report_says([&](const telemetry::Values& values) {
    sent = values[field("bus.frames_sent")];
    drops = values[field("bus.tx_drops")];
    mode = values[field("mode.mode")];
    return drops > 100;
  })) << output();
  EXPECT_EQ(sent, 0);
  EXPECT_EQ(mode, 0);  // disarmed, though it was to be armed
  vehicle->kill(SIGTERM);
  EXPECT_EQ(vehicle->wait().code, 0);
  EXPECT_NE(output().find("LISTEN-ONLY"), std::string::npos) << output();
  EXPECT_TRUE(controller_->take_frames().empty());
}

TEST_F(Vehicle, TheBusVerbSetsUpShowsAndRefuses) {
  const std::string& can = controller_->interface();
  EXPECT_EQ(bus({"status", can}), 0);
  EXPECT_NE(output().find(can + ": down"), std::string::npos) << output();
  ASSERT_EQ(bus({"up", can, "--bitrate", "250000", "--txqueuelen", "21"}), 0) << output();
  EXPECT_EQ(bus({"status", can}), 0);
  for (const char* part : {": up", "error-active", "250000 bit/s", "normal", "21 frames"})
    EXPECT_NE(output().find(part), std::string::npos) << part << " in " << output();
  EXPECT_EQ(bus({"up", can, "--restart-ms", "100"}), 2);
  EXPECT_NE(output().find("restart-ms refused by the driver"), std::string::npos) << output();
  EXPECT_EQ(bus({"up", can, "--bitrate", "123456"}), 2);
  EXPECT_NE(output().find("bit rate refused"), std::string::npos) << output();
  EXPECT_EQ(bus({"status", "vcan0"}), 0);
  EXPECT_NE(output().find("virtual"), std::string::npos) << output();
  EXPECT_EQ(bus({"up", "vcan0", "--bitrate", "500000"}), 2);
  EXPECT_NE(output().find("no CAN controller"), std::string::npos) << output();
}

}  // namespace
}  // namespace pitwall::slcan

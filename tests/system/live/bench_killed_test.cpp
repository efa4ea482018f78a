// The bench dies while the car drives. Car, base station, bench and the bus's hub are processes of
// this test, which hears what the car says whoever else lives. The car must say that the bus is
// dead within 100 ms of the last frame, disarm when nobody obeys, and not move under a bench that
// is started again. This test keeps the time of all of them, so that the machine costs none of it.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "hil/can_bus/own_hub.hpp"
#include "protocol/can/av21.hpp"
#include "protocol/telemetry/state_packet.hpp"
#include "protocol/transport/bench_clock/kept_clock.hpp"
#include "protocol/transport/can/can_socket.hpp"
#include "protocol/transport/clock.hpp"
#include "protocol/transport/file.hpp"
#include "protocol/transport/process.hpp"
#include "protocol/transport/udp_socket.hpp"
#include "protocol/yaml/strict_map.hpp"
#include "vehicle/world/mode.hpp"

namespace pitwall {
namespace {

using telemetry::field;
using transport::Process;
using transport::UdpSocket;
using Words = std::vector<std::string>;

constexpr Duration kReportLimit = milliseconds(100);
constexpr Duration kGapLimit = milliseconds(35);  // between two packets of the car, 20 ms apart
constexpr Duration kDisarmLimit = seconds(35);
constexpr double kFast_mps = 15.0;
constexpr const char* kScenario = "hil/scenarios/launch.yaml";

std::string clock_file() { return "/dev/shm/pitwall-bench-killed-" + std::to_string(::getpid()); }

std::string program(const char* variable) {
  const char* path = std::getenv(variable);
  EXPECT_NE(path, nullptr) << variable << " is not set";
  return path == nullptr ? "" : path;
}

std::optional<Process> spawn(Words words) {
  auto process = Process::spawn({.argv = std::move(words), .folder = PITWALL_SOURCE_DIR});
  EXPECT_TRUE(process) << (process ? "" : to_string(process.error()));
  if (!process) return std::nullopt;
  return *std::move(process);
}

// What the car said, and when it said it, by the clock that this machine has for everybody.
struct Statement {
  Instant sent{};
  double mode = kUnset, cause = kUnset, speed_mps = kUnset;
};

// The car's local report, listened to.
class Reports {
 public:
  Reports() {
    auto socket = UdpSocket::bind({});
    EXPECT_TRUE(socket);
    socket_ = std::make_unique<UdpSocket>(*std::move(socket));
  }
  std::uint16_t port() const { return socket_->local().port; }

  void read() {
    std::vector<transport::UdpDatagram> datagrams(UdpSocket::kBatch);
    const std::size_t count = socket_->receive(datagrams);
    for (const auto& d : std::span(datagrams).first(count))
      if (const auto packet = telemetry::parse(d.payload())) take(*packet);
  }

  const std::vector<Statement>& stated() const { return stated_; }
  Statement last() const { return stated_.empty() ? Statement{} : stated_.back(); }

 private:
  void take(const telemetry::StatePacket& p) {
    stated_.push_back({.sent = p.sent,
                       .mode = p.values[field("mode.mode")],
                       .cause = p.values[field("mode.first_stop_cause")],
                       .speed_mps = p.values[field("ego.vx")]});
  }

  std::unique_ptr<UdpSocket> socket_;
  std::vector<Statement> stated_;
};

bool is_of_the_bench(std::uint32_t id) {
  return std::ranges::any_of(can::av21::kMessages, [id](const can::MessageRow& row) {
    return row.id == id && row.direction == can::Direction::kFromCar;
  });
}

struct Attempt {
  bool drove = false;  // before the bench died
  std::optional<Instant> last_frame, report;
  Statement first_report;  // what it said then
  Duration longest_gap{};  // between packets, from the kill to the report
  bool disarmed = false;
  double top_speed_after_mps = kUnset;  // of the truth, under the bench that was started again
  bool disarmed_to_the_end = true;
};

class Experiment {
 public:
  Attempt run() {
    if (!start()) return result_;
    result_.drove = wait([this] { return reports_.last().speed_mps > kFast_mps; }, seconds(40));
    if (!result_.drove) return result_;
    transport::sleep_until(transport::monotonic_now() + milliseconds(1));
    kill_bench();
    result_.disarmed =
        wait([this] { return is(reports_.last().mode, world::Mode::kDisarmed); }, kDisarmLimit);
    if (result_.disarmed) start_bench_again();
    return result_;
  }

 private:
  static bool is(double mode, world::Mode wanted) { return mode == static_cast<double>(wanted); }

  std::string bus_name() const { return "unix:" + folder_->path() + "/bus"; }

  bool start() {
    auto hub = can_bus::OwnHub::start(program("PITWALL_BENCH_PROGRAM"), bus_name(), clock_file());
    EXPECT_TRUE(hub) << to_string(hub.error());
    if (!hub) return false;
    if (*hub) hub_.emplace(std::move(**hub));
    auto bus = transport::CanSocket::open(bus_name());
    EXPECT_TRUE(bus) << to_string(bus.error());
    if (!bus) return false;
    bus_.emplace(*std::move(bus));
    const std::string keys = folder_->path() + "/keys";
    auto keygen = spawn({program("PITWALL_BASE_PROGRAM"), "keygen", "--out", keys});
    if (!keygen || keygen->wait().code != 0) ADD_FAILURE() << "no keys";
    const std::string base_at = "127.0.0.1:" + std::to_string(kBasePort);
    base_ = spawn({program("PITWALL_BASE_PROGRAM"), "--listen", base_at, "--keys",
                   keys + "/base.keys", "--clock", clock_file()});
    car_ =
        spawn({program("PITWALL_VEHICLE_PROGRAM"), "--car", "vehicle/config/cars/av21.yaml",
               "--track", "vehicle/config/tracks/lvms.yaml", "--can", bus_name(), "--gnss",
               "23501,23502", "--radio", base_at, "--keys", keys + "/car.keys", "--local-report",
               std::to_string(reports_.port()), "--simulation", "--arm", "--clock", clock_file()});
    bench_ = spawn(bench_options("60"));
    return true;
  }

  Words bench_options(const std::string& seconds) const {
    return {program("PITWALL_BENCH_PROGRAM"),
            "run",
            kScenario,
            "--live",
            "--here",
            "--attach",
            "--interface",
            bus_name(),
            "--duration",
            seconds,
            "--out",
            folder_->path(),
            "--clock",
            clock_file(),
            "--json",
            json()};
  }
  std::string json() const { return folder_->path() + "/run.json"; }

  void look() {
    reports_.read();
    for (std::size_t count = bus_->receive(inbox_); count > 0; count = bus_->receive(inbox_))
      for (const auto& received : std::span(inbox_).first(count))
        if (is_of_the_bench(received.frame.id)) last_frame_ = received.at;
    transport::sleep_until(transport::monotonic_now() + milliseconds(2));
  }

  bool wait(const std::function<bool()>& until, Duration limit) {
    const Instant deadline = transport::monotonic_now() + limit;
    while (!until() && transport::monotonic_now() < deadline) look();
    return until();
  }

  void kill_bench() {
    bench_->kill(SIGKILL);
    bench_->wait();
    const Instant killed = transport::monotonic_now();
    const auto tells = [this] {
      return reports_.last().mode == static_cast<double>(world::Mode::kEmergencyStop) ||
             reports_.last().cause != 0.0;
    };
    const bool reported = wait(tells, seconds(5));
    result_.last_frame = last_frame_;
    if (!reported) return;
    Instant before = killed - milliseconds(20);
    for (const Statement& stated : reports_.stated()) {
      if (stated.sent < before) continue;
      result_.longest_gap = std::max(result_.longest_gap, stated.sent - before);
      before = stated.sent;
      if (stated.cause == 0.0) continue;
      result_.report = stated.sent;
      result_.first_report = stated;
      return;
    }
  }

  void start_bench_again() {
    bench_ = spawn(bench_options("20"));
    const bool ended = wait(
        [this] {
          result_.disarmed_to_the_end &= is(reports_.last().mode, world::Mode::kDisarmed) ||
                                         is(reports_.last().mode, world::Mode::kHalted);
          return bench_->poll().has_value();
        },
        seconds(40));
    if (!ended) return;
    if (const auto document = yaml::load_file(json()))
      result_.top_speed_after_mps = document->root().number("speed_max_mps", 0.0, 1e3);
  }

  static constexpr std::uint16_t kBasePort = 23'433;
  Result<transport::TemporaryFolder, Problem> folder_ =
      transport::TemporaryFolder::create("pitwall-bench-killed-");
  std::optional<can_bus::OwnHub> hub_;
  std::optional<transport::CanSocket> bus_;
  std::vector<can::ReceivedFrame> inbox_ = std::vector<can::ReceivedFrame>(256);
  Reports reports_;
  Instant last_frame_{};
  std::optional<Process> base_, car_, bench_;
  Attempt result_;
};

TEST(BenchKilled, TheCarReportsADeadBusDisarmsAndStaysWhereItIs) {
  ASSERT_TRUE(transport::use_clock(clock_file()));
  const auto kept = transport::KeptClock::keep(clock_file());
  ASSERT_TRUE(kept) << to_string(kept.error());
  const Attempt a = Experiment{}.run();
  ASSERT_TRUE(a.drove) << "a car that stands shows nothing";
  ASSERT_TRUE(a.last_frame && a.report) << "it never said a cause";
  EXPECT_EQ(
      telemetry::label_at(telemetry::kStopCauses, static_cast<std::size_t>(a.first_report.cause)),
      "CAN bus dead: the drive-by-wire is silent");
  EXPECT_EQ(a.first_report.mode, static_cast<double>(world::Mode::kEmergencyStop));
  EXPECT_TRUE(a.disarmed) << "nobody obeys";
  EXPECT_LT(a.top_speed_after_mps, 0.5) << "it moved and nobody armed it";
  EXPECT_TRUE(a.disarmed_to_the_end);
  EXPECT_LE(a.longest_gap, kGapLimit) << "a car that blocks says nothing meanwhile";
  EXPECT_LE(*a.report - *a.last_frame, kReportLimit);
}

}  // namespace
}  // namespace pitwall

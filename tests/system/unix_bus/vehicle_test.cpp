// The unmodified car on a hub that is killed, and on the one that comes after it.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <iterator>
#include <map>
#include <optional>
#include <span>
#include <sstream>
#include <string>
#include <vector>

#include "protocol/gnss/novatel_codec.hpp"
#include "protocol/recorder/segment_folder.hpp"
#include "protocol/recording/lcm_log.hpp"
#include "protocol/recording/mcap_reader.hpp"
#include "protocol/telemetry/session/crypto/keys.hpp"
#include "protocol/telemetry/session/crypto/randomness.hpp"
#include "protocol/telemetry/state_packet.hpp"
#include "protocol/transport/can/can_socket.hpp"
#include "protocol/transport/clock.hpp"
#include "protocol/transport/file.hpp"
#include "protocol/transport/process.hpp"
#include "protocol/transport/udp_socket.hpp"
#include "protocol/vocabulary/bytes.hpp"
#include "tests/support/comes_true.hpp"
#include "tests/support/in_time.hpp"
#include "tests/support/pty.hpp"
#include "tests/support/replaced.hpp"
#include "tests/support/tcp_server.hpp"

namespace pitwall {
namespace {

using telemetry::field;
using testing::comes_true;
using testing::in_time;
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
    auto report = transport::UdpSocket::bind({.ip = kLoopbackIp, .port = 0});
    ASSERT_TRUE(report) << to_string(report.error());
    report_.emplace(*std::move(report));
  }

  std::string bus() const { return "unix:" + folder_->path() + "/bus"; }
  std::string output() const {
    return transport::read_file(folder_->path() + "/said").value_or("");
  }

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
        << output();
    return out;
  }
  Process start_vehicle(const std::vector<std::string>& receivers = {"--gnss", "23511,23512"},
                        const std::vector<std::string>& base = {"--no-base"}) {
    std::vector<std::string> argv{
        program("PITWALL_VEHICLE_PROGRAM", "/build/release/vehicle/pitwall-vehicle"),
        "--car",
        kRoot + "/vehicle/config/cars/av21.yaml",
        "--track",
        kRoot + "/vehicle/config/tracks/lvms.yaml",
        "--can",
        bus(),
        "--local-report",
        std::to_string(report_->local().port),
        "--summary",
        folder_->path() + "/summary.json",
        "--record",
        folder_->path() + "/recording",
        "--simulation"};
    for (const auto* const more : {&receivers, &base})
      argv.insert(argv.end(), more->begin(), more->end());
    return spawn(argv);
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

  // How often the car's standard error has this.
  std::size_t times_stated(std::string_view what) const {
    const std::string all = output();
    std::size_t times = 0;
    for (std::size_t at = 0; (at = all.find(what, at)) != std::string::npos; ++at) ++times;
    return times;
  }
  std::uint64_t recorded(const std::string& topic) const {
    const auto paths = recorder::segments_of(folder_->path() + "/recording");
    std::uint64_t messages = 0;
    for (const std::string& path : *paths) {
      const auto file = transport::read_file(path);
      recording::McapReader reader{as_bytes(*file)};
      while (const auto message = reader.next())
        messages += reader.channels().at(message->channel).topic == topic ? 1U : 0U;
    }
    return messages;
  }

  // The car's own recording: whole, with what it said and how it was, and its LCM log beside it.
  void expect_recorded() {
    const auto paths = recorder::segments_of(folder_->path() + "/recording");
    ASSERT_TRUE(paths) << to_string(paths.error());
    ASSERT_EQ(paths->size(), 1U);
    std::map<std::string, std::uint64_t> messages;
    const auto file = transport::read_file(paths->front());
    recording::McapReader reader{as_bytes(*file)};
    std::uint64_t all = 0;
    while (const auto message = reader.next()) {
      ++messages[reader.channels().at(message->channel).topic];
      ++all;
    }
    EXPECT_EQ(reader.end(), recording::McapEnd::kComplete);
    EXPECT_GT(messages["/can/out"], 0U);
    EXPECT_GT(messages["/car/bus"], 0U);
    const auto log =
        transport::read_file(paths->front().substr(0, paths->front().size() - 5) + ".lcm");
    ASSERT_TRUE(log) << to_string(log.error());
    recording::LcmLogReader events{as_bytes(*log)};
    while (events.next()) continue;
    EXPECT_EQ(events.events() + messages["/base/picture"] + messages["/car/tick"], all);
  }

  std::optional<transport::TemporaryFolder> folder_;
  std::optional<transport::UdpSocket> report_;
};

// Frames of the car on the bus as somebody hears it who joins now.
bool car_is_received(const std::string& bus) {
  auto socket = transport::CanSocket::open(bus);
  if (!socket) return false;
  std::vector<can::ReceivedFrame> frames(64);
  return comes_true([&] { return socket->receive(frames) > 0; });
}

TEST_F(VehicleOnUnixBus, SeesItsHubDieAndSpeaksToTheNextOne) {
  std::optional<Process> hub = start_hub();
  Process vehicle = start_vehicle();
  EXPECT_TRUE(car_is_received(bus())) << output();
  EXPECT_TRUE(controller_is(kUnknown)) << output();  // up, and no controller that could tell
  hub->kill(SIGKILL);
  hub->wait();
  EXPECT_TRUE(controller_is(kDown)) << output();
  EXPECT_TRUE(std::filesystem::exists(folder_->path() + "/bus"));  // stale, and no obstacle
  hub.emplace(start_hub());
  EXPECT_TRUE(car_is_received(bus())) << output();
  EXPECT_TRUE(controller_is(kUnknown)) << output();
  vehicle.kill(SIGTERM);
  EXPECT_EQ(vehicle.wait().code, 0) << output();
  EXPECT_TRUE(std::filesystem::exists(folder_->path() + "/summary.json"));
  expect_recorded();
  hub->kill(SIGTERM);
  EXPECT_EQ(hub->wait().code, 0);
  EXPECT_NE(output().find("frames relayed"), std::string::npos) << output();
  EXPECT_FALSE(std::filesystem::exists(folder_->path() + "/bus"));
}

// Keys of another pair than the base's: to the car a base that never answers. Who then floods it
// is one line, not fifty thousand.
TEST_F(VehicleOnUnixBus, TellsAtItsOwnTerminalOfASilentBaseAndOfAFlood) {
  telemetry::SeededRandomness randomness(3);
  telemetry::KeyFile keys;
  keys.own = telemetry::make_identity(randomness);
  keys.peer = telemetry::make_identity(randomness).public_key;
  const std::string key_file = folder_->path() + "/car.keys";
  ASSERT_TRUE(transport::write_private_file(key_file, telemetry::text_of(keys)));
  auto base = transport::UdpSocket::bind({.ip = kLoopbackIp, .port = 0});
  ASSERT_TRUE(base) << to_string(base.error());
  Process hub = start_hub();
  Process vehicle = start_vehicle({"--gnss", "23511,23512"},
                                  {"--radio", to_string(base->local()), "--keys", key_file});
  std::vector<transport::UdpDatagram> datagrams(8);
  ASSERT_TRUE(comes_true([&] { return base->receive(datagrams) > 0; })) << output();
  const UdpAddress car = datagrams[0].from;
  const Instant opened = transport::monotonic_now();
  EXPECT_TRUE(comes_true([&] { return times_stated("no answer from the base station") > 0; }))
      << output();
  EXPECT_TRUE(in_time(transport::monotonic_now() - opened, seconds(2)));
  const std::vector<std::uint8_t> noise(60, 0xFF);
  const Instant flooded = transport::monotonic_now();
  const auto flood = [&] {
    for (int i = 0; i < 50; ++i) base->send_to(car, noise);
    return times_stated("radio, seen by the car: Forged or foreign datagrams") > 0;
  };
  EXPECT_TRUE(comes_true(flood)) << output();
  EXPECT_TRUE(in_time(transport::monotonic_now() - flooded, seconds(2)));
  EXPECT_TRUE(report_says([&](const telemetry::Values& v) {
    flood();
    return v[field("radio.threats")] == 4.0;
  })) << output();
  vehicle.kill(SIGTERM);
  EXPECT_EQ(vehicle.wait().code, 0) << output();
  EXPECT_EQ(times_stated("no answer from the base station"), 1U);
  EXPECT_EQ(times_stated("radio, seen by the car"), 1U);
  EXPECT_EQ(recorded("/base/event"), 2U);
}

// The words between the first two backquotes of docs/your_car.md that begin with --receiver.
std::string example_of_receivers() {
  const std::string page = transport::read_file(kRoot + "/docs/your_car.md").value_or("");
  const std::size_t begin = page.find("`--receiver ") + 1;
  return page.substr(begin, page.find('`', begin) - begin);
}

std::vector<std::string> words_of(const std::string& text) {
  std::istringstream in(text);
  return {std::istream_iterator<std::string>(in), {}};
}

std::vector<std::uint8_t> position_log(std::uint8_t satellites) {
  gnss::NovatelHeader header;
  header.week = 2190, header.milliseconds = 1'000;
  gnss::BestPos position{.solution_status = 0, .position_type = 50};
  position.latitude_deg = 36.27, position.longitude_deg = -115.01, position.height_m = 594.0;
  position.satellites_tracked = position.satellites_used = satellites;
  std::vector<std::uint8_t> log(gnss::kMaxEncodedBytes);
  log.resize(gnss::encode(header, position, log));
  return log;
}

// The page's own example: only its address and its device are those of this test.
TEST_F(VehicleOnUnixBus, HearsOneReceiverOverTcpAndTheOtherOverASerialLine) {
  support::TcpServer tcp;
  const support::Pty serial;
  std::string example = example_of_receivers();
  example =
      testing::replaced(example, "192.168.1.10:3001", "127.0.0.1:" + std::to_string(tcp.port()));
  example = testing::replaced(example, "/dev/ttyS0", serial.path());
  Process hub = start_hub();
  Process vehicle = start_vehicle(words_of(example));
  tcp.accept();
  ASSERT_TRUE(controller_is(kUnknown)) << output();  // it runs, so its serial line is open
  EXPECT_TRUE(report_says([&](const telemetry::Values& v) {
    tcp.say(position_log(17));
    serial.say(position_log(11));
    return v[field("gnss0.satellites")] == 17 && v[field("gnss1.satellites")] == 11;
  })) << output();
  vehicle.kill(SIGTERM);
  EXPECT_EQ(vehicle.wait().code, 0) << output();
  const auto summary = transport::read_file(folder_->path() + "/summary.json");
  ASSERT_TRUE(summary);
  EXPECT_NE(summary->find("serial:" + serial.path() + ":460800"), std::string::npos) << *summary;
}

TEST_F(VehicleOnUnixBus, WithoutAHubTheCarDoesNotStartAndSaysWhere) {
  Process vehicle = start_vehicle();
  EXPECT_NE(vehicle.wait().code, 0);
  EXPECT_NE(output().find(bus() + ": error: nobody serves this bus"), std::string::npos)
      << output();
}

TEST_F(VehicleOnUnixBus, AHubEndsByItselfAfterItsTimeAndASecondOneIsRefused) {
  Process hub = start_hub({"--seconds", "0.5"});
  Process second = spawn(
      {program("PITWALL_BENCH_PROGRAM", "/build/release/hil/pitwall-hil"), "bus", "hub", bus()});
  EXPECT_EQ(second.wait().code, 2);
  EXPECT_NE(output().find(bus() + ": error: in use"), std::string::npos) << output();
  EXPECT_EQ(hub.wait().code, 0);
}

}  // namespace
}  // namespace pitwall

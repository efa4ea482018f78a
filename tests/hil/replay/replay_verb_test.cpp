// What is refused before anything is sent, and a recording onto a bus and to an address on this
// machine; playing onto CAN of the kernel is tested in tests/system/vcan.
// SPDX-License-Identifier: Apache-2.0
#include "hil/replay/replay_verb.hpp"

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <thread>
#include <vector>

#include "protocol/transport/file.hpp"
#include "protocol/transport/stream/stream_sender.hpp"
#include "tests/hil/replay/recordings/recording_samples.hpp"
#include "tests/support/pty.hpp"
#include "tests/support/unix_bus_bench.hpp"

namespace pitwall::replay {
namespace {

class ReplayVerb : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(transport::write_file(good_, "(1.0) nosuchcan0 123#11\n"));
    ASSERT_TRUE(transport::write_file(
        bad_, "(1.0) nosuchcan0 123#11\n(1.1) nosuchcan0 123#1\n(1.2) nosuchcan0 123#11"));
  }
  std::string errors_of(const std::vector<std::string>& words) {
    ::testing::internal::CaptureStderr();
    EXPECT_EQ(replay_verb(words), 2);
    return ::testing::internal::GetCapturedStderr();
  }

  transport::TemporaryFolder folder_ = *transport::TemporaryFolder::create("pitwall-verb-");
  std::string good_ = folder_.path() + "/good.log";
  std::string bad_ = folder_.path() + "/bad.log";
};

TEST_F(ReplayVerb, BadLinesAndACutTailAreToldBeforeAnythingIsSent) {
  const std::string errors = errors_of({bad_});
  EXPECT_TRUE(errors.starts_with(bad_ + ":2:23: warning: left out: ")) << errors;
  EXPECT_NE(errors.find(bad_ + ":3: warning: left out: "), std::string::npos) << errors;
}

TEST_F(ReplayVerb, AFileThatIsNoLogIsNamedForWhatItLooksLike) {
  ASSERT_TRUE(transport::write_file(bad_, "MDF     4.10    "));
  const std::string errors = errors_of({bad_});
  EXPECT_TRUE(errors.starts_with(bad_ + ": error: looks like an ASAM MDF 4 recording")) << errors;
  EXPECT_NE(errors.find("candump"), std::string::npos) << errors;
}

TEST_F(ReplayVerb, AMissingFileOrInterfaceIsNamed) {
  EXPECT_TRUE(errors_of({folder_.path() + "/none.log"}).starts_with(folder_.path()));
  EXPECT_TRUE(errors_of({good_}).starts_with("nosuchcan0: error: "));
}

TEST_F(ReplayVerb, WrongUsageIsNamed) {
  EXPECT_TRUE(errors_of({}).starts_with("replay: error: "));
  EXPECT_TRUE(errors_of({good_, "--speed", "fast"}).starts_with("fast: error: "));
  EXPECT_TRUE(errors_of({good_, "--speed", "0"}).starts_with("speed: error: "));
  EXPECT_TRUE(errors_of({good_, "--map", "can7=vcan0"}).starts_with("can7: error: "));
  EXPECT_TRUE(errors_of({good_, "--receiver", "/gnss/0=3001"}).starts_with("/gnss/0: error: "));
  EXPECT_TRUE(errors_of({good_, "--clock", "bench"}).starts_with("bench: error: expected wall or"));
  EXPECT_TRUE(errors_of({good_, "--clock", "/none/t"}).starts_with("/none/t: error: "));
  EXPECT_TRUE(errors_of({good_, "--clock", folder_.path() + "/t", "--spin", "9"})
                  .starts_with("--spin: error: "));
  EXPECT_TRUE(errors_of({good_, "--id", "7FF"}).starts_with("--id 7FF: error: "));
  EXPECT_TRUE(errors_of({good_, "--topic", "can7"}).starts_with("can7: error: "));
  EXPECT_TRUE(errors_of({good_, "--until", "0"}).starts_with("until: error: "));
}

// A bus and a receiver's port, served and read by a thread while the verb plays.
class ReplayRecording : public pitwall::testing::UnixBusBench {
 protected:
  static constexpr std::uint32_t kSteps = 50, kLoops = 3;

  void SetUp() override {
    UnixBusBench::SetUp();
    client_ = std::make_unique<pitwall::testing::RawClient>(bus_);
    serve();
    auto port = transport::UdpSocket::bind({});
    ASSERT_TRUE(port);
    port_ = *std::move(port);
    box_ = folder_->path() + "/box.mcap";
    ASSERT_TRUE(transport::write_file(box_, traffic::testing::black_box(kSteps)));
  }

  void read_all() {
    serve();
    for (auto& packet : client_->read()) packets_.push_back(std::move(packet));
    std::vector<transport::UdpDatagram> some(16);
    while (const std::size_t n = port_->receive(some))
      for (std::size_t i = 0; i < n; ++i)
        datagrams_.emplace_back(some[i].payload().begin(), some[i].payload().end());
    std::array<std::uint8_t, 4'096> buffer;
    if (caller_) take(caller_->read(buffer, transport::monotonic_now()));
    take(std::span{buffer}.first(line_.read(buffer)));
  }
  void take(std::span<const std::uint8_t> bytes) { stream_.append(bytes.begin(), bytes.end()); }

  // What the receiver of the black box sends in one pass.
  static std::string receiver_bytes() {
    std::string all;
    for (std::uint32_t step = 0; step < kSteps; ++step)
      all += traffic::testing::novatel_position(2'297, 172'800'000 + 10 * step);
    return all;
  }

  // The exit code; said_ and warned_ are what it wrote.
  int play(std::vector<std::string> words) {
    words.insert(words.begin(), box_);
    std::atomic<bool> done = false;
    std::thread reader([&] {
      while (!done) {
        read_all();
        transport::sleep_until(transport::monotonic_now() + milliseconds(1));
      }
    });
    ::testing::internal::CaptureStdout();
    ::testing::internal::CaptureStderr();
    const int code = replay_verb(words);
    said_ = ::testing::internal::GetCapturedStdout();
    warned_ = ::testing::internal::GetCapturedStderr();
    done = true;
    reader.join();
    read_all();
    return code;
  }

  std::string address() const { return "/gnss/0=" + to_string(port_->local()); }

  std::unique_ptr<pitwall::testing::RawClient> client_;
  std::optional<transport::UdpSocket> port_;
  std::optional<transport::StreamLink> caller_;  // as the car calls its receiver
  support::Pty line_;                            // the other end of a serial line
  std::string stream_;                           // what came by either
  std::string box_, said_, warned_;
  std::vector<pitwall::testing::Packet> packets_;
  std::vector<std::string> datagrams_;
};

TEST_F(ReplayRecording, AllFramesHeardAndAllBytesOfTheReceiverComeInOrderInEveryLoop) {
  ASSERT_EQ(play({"--map", "/can/in=" + bus_, "--receiver", address(), "--loop", "3", "--speed",
                  "5", "--json", folder_->path() + "/out.json"}),
            0)
      << warned_;
  ASSERT_EQ(packets_.size(), kLoops * kSteps);
  ASSERT_EQ(datagrams_.size(), kLoops * kSteps);
  for (std::uint32_t i = 0; i < kLoops * kSteps; ++i) {
    const std::uint32_t step = i % kSteps;
    EXPECT_EQ(datagrams_[i], traffic::testing::novatel_position(2'297, 172'800'000 + 10 * step));
    const can::Frame frame = traffic::testing::some_frame(2 * step + recorder::kCanInChannel % 2);
    const transport::CanWire wire = pitwall::testing::wire_of(packets_[i]);
    EXPECT_EQ(wire.can_id & can::kMaxExtendedId, frame.id);
    EXPECT_EQ(wire.len, frame.length);
  }
  EXPECT_NE(said_.find("sent 150 frames and 150 datagrams"), std::string::npos) << said_;
  EXPECT_NE(said_.find("not played: 150 records of 3 sources"), std::string::npos) << said_;
  EXPECT_NE(warned_.find("not played: /can/out (50 records): "), std::string::npos) << warned_;
  EXPECT_TRUE(transport::read_file(folder_->path() + "/out.json"));
}

TEST_F(ReplayRecording, AReceiverAloneNeedsNoBusAndWhatTheCarSaidIsPlayedWhereItIsMapped) {
  ASSERT_EQ(play({"--receiver", address(), "--speed", "50"}), 0) << warned_;
  EXPECT_EQ(datagrams_.size(), kSteps);
  EXPECT_TRUE(packets_.empty());
  ASSERT_EQ(play({"--map", "/can/out=" + bus_, "--speed", "50"}), 0) << warned_;
  EXPECT_EQ(datagrams_.size(), kSteps);
  EXPECT_EQ(packets_.size(), kSteps);
}

TEST_F(ReplayRecording, ACarThatConnectsByTcpGetsAllBytesFromTheFirstOn) {
  auto free = transport::StreamSender::listen({});
  ASSERT_TRUE(free);
  const transport::TcpAddress address = free->local();
  const std::string target = "/gnss/0=tcp:" + to_string(address);
  EXPECT_EQ(play({"--receiver", target}), 2);  // the port is taken
  EXPECT_NE(warned_.find("\n" + to_string(address) + ": error: "), std::string::npos) << warned_;
  static_cast<void>(transport::StreamSender(*std::move(free)));  // closed again
  caller_.emplace(address);
  ASSERT_EQ(play({"--receiver", target, "--map", "/can/in=" + bus_, "--speed", "5", "--loop", "2",
                  "--json", folder_->path() + "/out.json"}),
            0)
      << warned_;
  EXPECT_EQ(stream_, receiver_bytes() + receiver_bytes());
  EXPECT_EQ(packets_.size(), 2 * kSteps);
  EXPECT_NE(warned_.find("tcp:127.0.0.1:"), std::string::npos) << warned_;
  const auto json = transport::read_file(folder_->path() + "/out.json");
  ASSERT_TRUE(json);
  EXPECT_NE(json->find("\"sent_bytes\": " + std::to_string(stream_.size())), std::string::npos);
}

TEST_F(ReplayRecording, ASerialLineCarriesTheBytesOfTheReceiver) {
  ASSERT_EQ(play({"--receiver", "/gnss/0=serial:" + line_.path() + ":115200", "--speed", "5"}), 0)
      << warned_;
  EXPECT_EQ(stream_, receiver_bytes());
  EXPECT_EQ(play({"--receiver", "/gnss/0=serial:/dev/no_such_tty"}), 2);
  EXPECT_NE(warned_.find("\n/dev/no_such_tty: error: "), std::string::npos) << warned_;
}

TEST_F(ReplayRecording, WithoutACallerTheRecordsAreDroppedAndTheExitCodeIsOne) {
  auto free = transport::StreamSender::listen({});
  ASSERT_TRUE(free);
  const std::string address = to_string(free->local());
  static_cast<void>(transport::StreamSender(*std::move(free)));  // closed again
  EXPECT_EQ(play({"--receiver", "/gnss/0=tcp:" + address, "--speed", "50"}), 1);
  EXPECT_NE(warned_.find("dropped 50 records without a reader"), std::string::npos) << warned_;
}

TEST_F(ReplayRecording, WhenNobodyListensItIsTold) {
  const std::string to = address();
  port_ = *transport::UdpSocket::bind({});
  ASSERT_EQ(play({"--receiver", to, "--speed", "50"}), 0);
  EXPECT_NE(warned_.find("nobody listened"), std::string::npos) << warned_;
}

TEST_F(ReplayRecording, UnknownSourcesAreRefusedWithThoseThatThereAre) {
  EXPECT_EQ(play({"--receiver", "/gnss/5=127.0.0.1:3001"}), 2);
  EXPECT_TRUE(warned_.starts_with("/gnss/5: error: ")) << warned_;
  EXPECT_NE(warned_.find("/gnss/0"), std::string::npos) << warned_;
  EXPECT_EQ(play({"--map", "can0=" + bus_}), 2);
  EXPECT_TRUE(warned_.starts_with("can0: error: ")) << warned_;
  EXPECT_EQ(play({}), 2);
  EXPECT_TRUE(warned_.starts_with("recording: error: nothing is left")) << warned_;
  EXPECT_TRUE(packets_.empty() && datagrams_.empty());
}

// Brake reports of the car's own bus at 100 Hz with a counter from 0 to 9, and a frame of race
// control beside each.
class ReplayCarBus : public ReplayRecording {
 protected:
  void SetUp() override {
    ReplayRecording::SetUp();
    box_ = folder_->path() + "/bus.log";
    std::string text;
    for (int i = 0; i < 35; ++i) {
      const std::string at = "(100." + std::to_string(100'000 + i * 10'000) + ") can0 ";
      text += at + "515#000000000" + std::to_string(i % 10) + "\n";
      text += at + "4B8#00\n";
    }
    ASSERT_TRUE(transport::write_file(box_, text));
  }
  std::vector<std::uint32_t> brake_counters() const {
    std::vector<std::uint32_t> counters;
    for (const auto& packet : packets_) {
      const transport::CanWire wire = pitwall::testing::wire_of(packet);
      if (wire.can_id == 0x515) counters.push_back(wire.data[4]);
    }
    return counters;
  }
  const std::string folder_of_cars_ = std::string(PITWALL_SOURCE_DIR) + "/protocol/can/dbc/";
};

TEST_F(ReplayCarBus, CountersGoOnOverLoopsWhereTheyAreRestamped) {
  const std::string manifest = folder_of_cars_ + "av21.manifest.yaml";
  ASSERT_EQ(play({"--interface", bus_, "--speed", "20", "--loop", "3"}), 0) << warned_;
  std::vector<std::uint32_t> counters = brake_counters();
  ASSERT_EQ(counters.size(), 105U);
  EXPECT_EQ(counters[34], 4U);
  EXPECT_EQ(counters[35], 0U);  // the seam
  packets_.clear();
  ASSERT_EQ(play({"--interface", bus_, "--speed", "20", "--loop", "3", "--restamp", manifest,
                  "--from", "0.02", "--json", folder_->path() + "/out.json"}),
            0)
      << warned_;
  counters = brake_counters();
  ASSERT_EQ(counters.size(), 99U);
  for (std::uint32_t i = 0; i < counters.size(); ++i) EXPECT_EQ(counters[i], (i + 2) % 10);
  EXPECT_NE(said_.find("restamped: 33 frames of a pass"), std::string::npos) << said_;
  const auto json = transport::read_file(folder_->path() + "/out.json");
  EXPECT_NE(json.value_or("").find("\"restamped_per_pass\": 33"), std::string::npos);
  EXPECT_EQ(play({"--interface", bus_, "--id", "4B8", "--restamp", manifest}), 2);
  EXPECT_TRUE(warned_.starts_with(manifest + ": error: gives none of the frames")) << warned_;
}

TEST_F(ReplayCarBus, WhatANodeSendsIsLeftOutByTheDatabase) {
  const std::string dbc = folder_of_cars_ + "av21.dbc";
  ASSERT_EQ(play({"--interface", bus_, "--speed", "20", "--dbc", dbc, "--overlay", "DriveByWire"}),
            0)
      << warned_;
  EXPECT_EQ(packets_.size(), 35U);
  EXPECT_TRUE(brake_counters().empty());
  EXPECT_NE(said_.find("not played: 35 frames of a pass"), std::string::npos) << said_;
  EXPECT_EQ(play({"--interface", bus_, "--dbc", dbc, "--overlay", "Computer"}), 2);
  EXPECT_TRUE(warned_.ends_with(": DriveByWire, RaceControl\n") ||
              warned_.ends_with(": RaceControl, DriveByWire\n"))
      << warned_;
}

}  // namespace
}  // namespace pitwall::replay

// Replay over vcan0, judged by two programs that are not ours: candump records what arrives, and
// python-can reads the log that is played.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <vector>

#include "hil/replay/formats/candump.hpp"
#include "hil/replay/writers/candump_writer.hpp"
#include "protocol/transport/can/can_socket.hpp"
#include "protocol/transport/clock.hpp"
#include "protocol/transport/file.hpp"
#include "protocol/transport/process.hpp"
#include "tests/support/public_data.hpp"

namespace pitwall::replay {
namespace {

namespace fs = std::filesystem;

std::string replay_program() {
  const char* program = std::getenv("PITWALL_REPLAY_PROGRAM");
  return program == nullptr ? "pitwall-hil" : program;
}

// candump, recording all of vcan0 to a file until it is told to stop.
class Recorder {
 public:
  explicit Recorder(const std::string& path) : path_(path) {
    auto process = transport::Process::spawn(
        {.argv = {"sh", "-c", "exec candump -L -r 8388608 vcan0 > \"$0\"", path}});
    EXPECT_TRUE(process.has_value());
    if (process) candump_.emplace(*std::move(process));
    wait_until_it_listens();
  }
  CanLog stop() {
    wait_until_all_is_written();
    candump_->kill(SIGINT);
    static_cast<void>(candump_->wait());
    const auto text = transport::read_file(path_);
    EXPECT_TRUE(text.has_value());
    auto log = read_candump(text.value_or(""), path_);
    EXPECT_TRUE(log.has_value()) << (log ? "" : to_string(log.error()));
    if (!log) return {};
    auto& frames = log->frames;
    std::erase_if(frames, [](const LoggedFrame& f) { return f.frame.id == kProbe; });
    return *std::move(log);
  }

 private:
  static constexpr std::uint32_t kProbe = 0x7FF;  // occurs in no log that is played here

  // Sends a probe frame until one of them is in the file: from then on nothing is missed.
  void wait_until_it_listens() {
    send_until({.id = kProbe}, 1, [this] { return fs::exists(path_) && fs::file_size(path_) > 0; });
  }

  // Until a frame that was sent last is in the file, whose writer is slow and writes whole blocks.
  void wait_until_all_is_written() {
    can::Frame last{.id = kProbe, .length = 1};
    send_until(last, 100, [this] {
      return transport::read_file(path_).value_or("").find("7FF#00") != std::string::npos;
    });
  }

  void send_until(const can::Frame& frame, int at_once, const std::function<bool()>& done) {
    auto socket = transport::CanSocket::open("vcan0");
    ASSERT_TRUE(socket.has_value());
    const Instant give_up = transport::monotonic_now() + seconds(60);
    while (transport::monotonic_now() < give_up) {
      for (int i = 0; i < at_once; ++i) socket->send(frame);
      transport::sleep_until(transport::monotonic_now() + milliseconds(50));
      if (done()) return;
    }
    FAIL() << "candump does not record";
  }

  std::string path_;
  std::optional<transport::Process> candump_;
};

int play(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), {replay_program(), "replay"});
  auto process = transport::Process::spawn({.argv = std::move(arguments)});
  return process ? process->wait().shell_code() : -1;
}

void expect_same_frames(const CanLog& got, const CanLog& wanted, std::size_t passes) {
  ASSERT_EQ(got.frames.size(), wanted.frames.size() * passes);
  for (std::size_t i = 0; i < got.frames.size(); ++i)
    ASSERT_EQ(got.frames[i].frame, wanted.frames[i % wanted.frames.size()].frame) << "frame " << i;
}

CanLog read_log(const std::string& path) {
  const auto text = transport::read_file(path);
  EXPECT_TRUE(text.has_value()) << path;
  auto log = read_candump(text.value_or(""), path);
  EXPECT_TRUE(log.has_value()) << (log ? "" : to_string(log.error()));
  return log ? *std::move(log) : CanLog{};
}

// The log as python-can understands it, one candump line per message.
std::string as_python_can_reads_it(const std::string& log) {
  auto folder = transport::TemporaryFolder::create("pitwall-python-");
  if (!folder) return {};
  const std::string out = folder->path() + "/messages";
  const std::string script =
      "import can, sys\n"
      "with open(sys.argv[2], 'w') as out:\n"
      "  for m in can.CanutilsLogReader(sys.argv[1]):\n"
      "    id = '%08X' % m.arbitration_id if m.is_extended_id else '%03X' % m.arbitration_id\n"
      "    out.write('(%.6f) %s %s#%s\\n' % (m.timestamp, m.channel, id, m.data.hex().upper()))\n";
  auto python = transport::Process::spawn({.argv = {"/usr/bin/python3", "-c", script, log, out}});
  if (!python || !python->wait().success()) return {};
  return transport::read_file(out).value_or("");
}

TEST(PublicCandump, ARealLogArrivesCompleteAndInOrder) {
  using namespace recordings;
  if (!is_here(kCandump)) GTEST_SKIP() << how_to_get(kCandump);
  const std::string path = path_of(kCandump).lexically_normal().string();
  auto folder = transport::TemporaryFolder::create("pitwall-replay-");
  ASSERT_TRUE(folder.has_value());
  const CanLog log = read_log(path);
  ASSERT_GT(log.frames.size(), 6'000U);
  Recorder recorder(folder->path() + "/arrived.log");
  ASSERT_EQ(play({path, "--interface", "vcan0", "--speed", "2"}), 0);
  expect_same_frames(recorder.stop(), log, 1);
  const auto oracle = read_candump(as_python_can_reads_it(path), "python-can");
  ASSERT_TRUE(oracle.has_value());
  expect_same_frames(*oracle, log, 1);
}

TEST(Replay, PassesFollowEachOtherWithoutASeam) {
  auto folder = transport::TemporaryFolder::create("pitwall-replay-");
  ASSERT_TRUE(folder.has_value());
  const std::string path = folder->path() + "/made.log";
  CanLog made;
  made.channels = {"can0"};
  std::string text;
  for (int i = 0; i < 500; ++i) {
    LoggedFrame f;
    f.at = {1'700'000'000 * kNanosecondsPerSecond + i * 1'000'000};
    f.frame.id = static_cast<std::uint32_t>(i);
    f.frame.length = 2;
    f.frame.data[1] = static_cast<std::uint8_t>(i % 251);
    made.frames.push_back(f);
    text += to_candump_line(f, "can0") + "\n";
  }
  ASSERT_TRUE(transport::write_file(path, text).has_value());
  Recorder recorder(folder->path() + "/arrived.log");
  ASSERT_EQ(play({path, "--map", "can0=vcan0", "--loop", "3"}), 0);
  const CanLog arrived = recorder.stop();
  expect_same_frames(arrived, made, 3);
  // Half a second per pass: the clock of the schedule does not restart late. Only a lower bound is
  // a law on a busy machine: nothing may go out before its time.
  const std::int64_t took_ns = arrived.frames.back().at.ns - arrived.frames.front().at.ns;
  EXPECT_GT(took_ns, 1'499 * 1'000'000LL - 50'000'000LL);
}

TEST(Replay, FlagsOfFdFramesChosenIdentifiersAndLatePoliciesReachTheBus) {
  auto folder = transport::TemporaryFolder::create("pitwall-replay-");
  ASSERT_TRUE(folder.has_value());
  const std::string path = folder->path() + "/made.log", json = folder->path() + "/report.json";
  std::string text;
  for (int i = 0; i < 200; ++i)
    text += "(1700000000." + std::to_string(100'000 + i * 1'000) + ") can0 " +
            (i % 2 == 0 ? "123##1AABB" : "00000124#R5") + "\n";
  ASSERT_TRUE(transport::write_file(path, text).has_value());
  Recorder recorder(folder->path() + "/arrived.log");
  // Nothing is an hour late: no frame is dropped by either policy.
  ASSERT_EQ(play({path, "--interface", "vcan0", "--late", "drop:3600000", "--json", json}), 0);
  ASSERT_EQ(play({path, "--interface", "vcan0", "--late", "abort:3600000", "--spin", "0", "--id",
                  "123", "--from", "0.1"}),
            0);
  const CanLog arrived = recorder.stop();
  const CanLog wanted = read_log(path);
  ASSERT_EQ(arrived.frames.size(), 250U);  // all of the first replay, a quarter in the second
  for (std::size_t i = 0; i < 250; ++i) {
    const LoggedFrame& frame = wanted.frames[i < 200 ? i : 0];
    ASSERT_EQ(arrived.frames[i].frame, frame.frame) << i;
    ASSERT_EQ(arrived.frames[i].fd_flags & 1, frame.fd_flags & 1) << i;  // bit rate switch
  }
  const std::string report = transport::read_file(json).value_or("");
  EXPECT_NE(report.find("\"sent\": 200,"), std::string::npos) << report;
  EXPECT_NE(report.find("\"dropped_late\": 0,"), std::string::npos) << report;
}

TEST(Replay, OfAMalformedLogTheGoodLinesAreSentAndTheTailIsNot) {
  auto folder = transport::TemporaryFolder::create("pitwall-replay-");
  ASSERT_TRUE(folder.has_value());
  const std::string path = folder->path() + "/bad.log";
  ASSERT_TRUE(transport::write_file(path,
                                    "(1.000000) can0 123#11\n(1.000001) can0 12#11\n"
                                    "(1.000002) can0 124#\n(1.000003) can0 125#11"));
  Recorder recorder(folder->path() + "/arrived.log");
  EXPECT_EQ(play({path, "--interface", "vcan0"}), 0);
  const CanLog arrived = recorder.stop();
  ASSERT_EQ(arrived.frames.size(), 2U);
  EXPECT_EQ(arrived.frames[0].frame.id, 0x123U);
  EXPECT_EQ(arrived.frames[1].frame.id, 0x124U);
}

}  // namespace
}  // namespace pitwall::replay

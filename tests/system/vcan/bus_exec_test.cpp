// `pitwall-hil bus exec` as its callers see it: exit codes, output, environment, files, time-out,
// the line. Real processes; a guest boots where the kernel has no CAN.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <array>
#include <csignal>
#include <cstdlib>
#include <string>
#include <vector>

#include "protocol/transport/clock.hpp"
#include "protocol/transport/file.hpp"
#include "protocol/transport/process.hpp"
#include "protocol/transport/readiness.hpp"
#include "protocol/transport/udp_socket.hpp"

namespace pitwall::transport {
namespace {

std::string bus_program() {
  const char* program = std::getenv("PITWALL_BUS_PROGRAM");
  return program == nullptr ? "pitwall-hil" : program;
}

struct Ran {
  int code = -1;
  std::string output, errors;
};

class BusExec : public testing::Test {
 protected:
  Process start(const std::vector<std::string>& options, const std::vector<std::string>& command) {
    std::vector<std::string> argv{bus_program(), "bus", "exec"};
    argv.insert(argv.end(), options.begin(), options.end());
    argv.push_back("--");
    argv.insert(argv.end(), command.begin(), command.end());
    auto output = AppendWriter::open(folder_.path() + "/output", AppendWriter::Start::kTruncate);
    auto errors = AppendWriter::open(folder_.path() + "/errors", AppendWriter::Start::kTruncate);
    auto process = Process::spawn({.argv = argv,
                                   .descriptors = {{output->fd(), 1}, {errors->fd(), 2}},
                                   .environment = {"PITWALL_TEST_WORD=it's \"here\" $HOME"},
                                   .folder = folder_.path()});
    EXPECT_TRUE(process.has_value());
    return *std::move(process);
  }
  Ran finish(Process process) {
    Ran ran;
    ran.code = process.wait().shell_code();
    ran.output = read_file(folder_.path() + "/output").value_or("");
    ran.errors = read_file(folder_.path() + "/errors").value_or("");
    return ran;
  }
  Ran run(const std::vector<std::string>& options, const std::vector<std::string>& command) {
    return finish(start(options, command));
  }

  TemporaryFolder folder_ = *TemporaryFolder::create("pitwall-bus-");
};

TEST_F(BusExec, TheCommandsExitCodeOutputAndErrorsAreOurs) {
  const auto ran = run({"--timeout", "60"}, {"sh", "-c", "echo out; echo err >&2; exit 37"});
  EXPECT_EQ(ran.code, 37) << ran.errors;
  EXPECT_EQ(ran.output, "out\n");
  EXPECT_EQ(ran.errors, "err\n");
}

TEST_F(BusExec, FolderEnvironmentFilesAndInterfacesAreThere) {
  const auto ran = run({"--timeout", "60", "--interface", "vcan0", "--interface", "vcan7"},
                       {"sh", "-c",
                        "pwd; echo \"$PITWALL_TEST_WORD\"; ls /sys/class/net | grep vcan; "
                        "echo kept > result; id -u > /dev/null"});
  EXPECT_EQ(ran.code, 0) << ran.errors;
  EXPECT_EQ(ran.output, folder_.path() + "\nit's \"here\" $HOME\nvcan0\nvcan7\n");
  EXPECT_EQ(read_file(folder_.path() + "/result").value_or(""), "kept\n");
}

TEST_F(BusExec, MuchOutputArrivesToTheLastByte) {
  const auto ran = run({"--timeout", "60"}, {"seq", "1", "200000"});
  EXPECT_EQ(ran.code, 0) << ran.errors;
  ASSERT_EQ(ran.output.size(), 1'288'895U);
  EXPECT_TRUE(ran.output.ends_with("\n199999\n200000\n"));
}

TEST_F(BusExec, TooLongIsATimeOut) {
  const auto ran = run({"--timeout", "5"}, {"sleep", "1000"});
  EXPECT_EQ(ran.code, 124);
  EXPECT_NE(ran.errors.find("longer than"), std::string::npos);
}

TEST_F(BusExec, TheLineCarriesDatagramsBothWays) {
  // The command echoes what it gets on GUEST_DEST to GUEST_LISTEN, until it is told to stop.
  const std::string echo =
      "import socket, sys\n"
      "s = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)\n"
      "s.bind(('127.0.0.1', 47114)); s.settimeout(60)\n"
      "s.sendto(b'ready', ('127.0.0.1', 47113))\n"
      "while True:\n"
      "  d = s.recv(4096)\n"
      "  if d == b'stop': sys.exit(11)\n"
      "  s.sendto(d, ('127.0.0.1', 47113))\n";
  auto here = UdpSocket::bind({.port = 47112});
  ASSERT_TRUE(here.has_value()) << to_string(here.error());
  Process bus = start({"--timeout", "120", "--line-udp", "47111:47112:47113:47114"},
                      {"/usr/bin/python3", "-c", echo});
  const auto receive = [&] {
    std::vector<UdpDatagram> got(1);
    const int watched[] = {here->fd()};
    wait_readable(watched, monotonic_now() + seconds(60));
    return here->receive(got) == 1 ? std::string(got[0].payload().begin(), got[0].payload().end())
                                   : std::string("nothing");
  };
  const auto send = [&](const std::string& text) {
    return here->send_to({.port = 47111},
                         {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
  };
  ASSERT_EQ(receive(), "ready");
  for (std::size_t size = 1; size <= 1'400; size += 37) {
    std::string text;  // every byte value, magic of the framing included
    for (std::size_t i = 0; i < size; ++i) text += static_cast<char>(i * 7 + size);
    ASSERT_TRUE(send(text));
    ASSERT_EQ(receive(), text) << size;
  }
  ASSERT_TRUE(send("stop"));
  EXPECT_EQ(finish(std::move(bus)).code, 11);
}

TEST_F(BusExec, AGuestEndsWithTheOneWhoStartedIt) {
  Process bus = start({"--guest"}, {"sh", "-c", "echo yes; while :; do :; done"});
  for (int i = 0; i < 300 && read_file(folder_.path() + "/output").value_or("").empty(); ++i)
    sleep_until(monotonic_now() + milliseconds(100));
  ASSERT_EQ(read_file(folder_.path() + "/output").value_or(""), "yes\n");
  bus.kill(SIGKILL);
  static_cast<void>(bus.wait());
  // No process of that guest (it carries its folder in its arguments) may survive.
  const std::string look =
      "exec 2> /dev/null; for i in 1 2 3 4 5 6 7 8 9 10; do "
      "  n=0; for p in /proc/[0-9]*; do "
      "    tr '\\0' ' ' < $p/cmdline | grep -q \"^linux.uml .*ssl0=fd\" && "
      "    [ \"$(readlink $p/cwd)\" = \"$0\" ] && n=$((n+1)); done; "
      "  [ $n = 0 ] && exit 0; sleep 0.5; done; exit 1";
  auto looked = Process::spawn({.argv = {"sh", "-c", look, folder_.path()}});
  ASSERT_TRUE(looked.has_value());
  EXPECT_TRUE(looked->wait().success());
}

TEST_F(BusExec, WrongUsageIsNamed) {
  for (const std::vector<std::string>& options : {std::vector<std::string>{"--nonsense", "1"},
                                                  {"--timeout", "soon"},
                                                  {"--line-udp", "1:2:3"},
                                                  {"--interface", "bad name"}}) {
    const auto ran = run(options, {"true"});
    EXPECT_EQ(ran.code, 2);
    EXPECT_NE(ran.errors.find("error: "), std::string::npos) << ran.errors;
  }
}

}  // namespace
}  // namespace pitwall::transport

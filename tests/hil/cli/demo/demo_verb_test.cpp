// What can be told of the demonstration without starting it; the rest is tests/system/live.
// SPDX-License-Identifier: Apache-2.0
#include "hil/cli/demo/demo_verb.hpp"

#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <string>
#include <utility>

#include "protocol/transport/posix_call.hpp"
#include "tests/hil/cli/program_run.hpp"

namespace pitwall::cli {
namespace {

class DemoVerb : public ProgramRun {};

// A program that serves some port of this machine.
std::pair<transport::FileDescriptor, int> another_program() {
  using transport::posix_call;
  transport::FileDescriptor socket{posix_call([] { return ::socket(AF_INET, SOCK_STREAM, 0); })};
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof address;
  void* const raw = &address;
  EXPECT_TRUE(posix_call([&] { return ::bind(socket.get(), static_cast<sockaddr*>(raw), size); }));
  EXPECT_TRUE(posix_call([&] { return ::listen(socket.get(), 4); }));
  EXPECT_TRUE(
      posix_call([&] { return ::getsockname(socket.get(), static_cast<sockaddr*>(raw), &size); }));
  return {std::move(socket), ntohs(address.sin_port)};
}

TEST_F(DemoVerb, WrongUsageIsTold) {
  expect_refusal({"demo", "--no-such-flag"}, "--no-such-flag");
  expect_refusal({"demo", "surplus"}, "surplus");
  expect_refusal({"demo", "--duration", "0"}, "--duration");
  expect_refusal({"demo", "--duration", "long"}, "long");
}

TEST_F(DemoVerb, HelpIsNoError) {
  const ProgramOutput output = run({"demo", "--help"});
  EXPECT_EQ(output.code, 0);
  EXPECT_NE(output.out.find("--headless"), std::string::npos);
}

TEST_F(DemoVerb, ABadScenarioIsToldWithItsPlaceAndNothingIsStarted) {
  const std::string bad = spoilt("launch_and_stop.yaml", "seed: 11", "seed: eleven");
  expect_refusal({"demo", "--headless", "--scenario", bad, "--out", path("demo")},
                 bad + ":4:7: error: ");
  EXPECT_FALSE(exists("demo"));
  expect_refusal({"demo", "--scenario", path("none.yaml"), "--out", path("demo")},
                 path("none.yaml"));
  EXPECT_FALSE(exists("demo"));
}

TEST_F(DemoVerb, APortThatAnotherProgramServesIsToldBeforeTheCarStarts) {
  const auto [socket, port] = another_program();
  expect_refusal({"demo", "--headless", "--web", std::to_string(port), "--out", path("demo")},
                 "--web " + std::to_string(port) + ": error: another program serves this port");
  EXPECT_FALSE(exists("demo/candump.log"));
}

TEST_F(DemoVerb, AFolderThatCannotBeMadeIsTold) {
  ASSERT_TRUE(transport::write_file(path("file"), "in the way"));
  expect_refusal({"demo", "--headless", "--out", path("file/demo")}, path("file/demo"));
  EXPECT_EQ(run({"demo", "--headless", "--out", path("file/demo")}).out, "");
}

}  // namespace
}  // namespace pitwall::cli

// `pitwall-hil bench gateway` for five seconds: real vcan, the real car process. What does not
// depend on time holds on any machine: nothing is lost at 27,000 frames/s, and what the kernel
// loses is counted to the frame. Whether a report of the car came within 100 ms can only be asked
// of a run in which the machine woke the sender and the listeners, which are not the car, in time.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <string>
#include <vector>

#include "protocol/transport/file.hpp"
#include "protocol/transport/process.hpp"
#include "protocol/yaml/strict_map.hpp"
#include "tests/support/in_time.hpp"

namespace pitwall {
namespace {

constexpr Duration kQuiet = milliseconds(20);  // two ticks of the car: no wake-up was later
constexpr std::int64_t kMost = 1'000'000'000;

struct Judged {
  std::int64_t omitted = 0, reported = 0, in_time = 0, twice = 0, false_reports = 0;
};

struct Queue {
  std::int64_t counted = 0, missing = 0;
  bool trailing = false;
};

struct Experiment {
  std::int64_t sent = 0, car_received = 0, listener_received = 0;
  Duration latest{};  // wake-up of sender or receivers
  Judged by_car, by_listener;
  std::vector<Queue> queue;
};

Judged read_judged(yaml::StrictMap map) {
  Judged judged;
  judged.omitted = map.integer("omitted", 0, kMost);
  judged.reported = map.integer("reported", 0, kMost);
  judged.in_time = map.integer("in_time", 0, kMost);
  judged.twice = map.integer("twice", 0, kMost);
  judged.false_reports = map.integer("false", 0, kMost);
  return judged;
}

Experiment read_experiment(yaml::StrictMap map) {
  Experiment e;
  e.sent = map.integer("sent", 0, kMost);
  e.car_received = map.integer("car_received", 0, kMost);
  e.listener_received = map.integer("listener_received", 0, kMost);
  e.latest = from_seconds(
      1e-6 * std::max(map.number("late_max_us", 0.0, 1e12), map.number("wake_max_us", 0.0, 1e12)));
  e.by_car = read_judged(map.map("by_car"));
  e.by_listener = read_judged(map.map("by_listener"));
  for (yaml::StrictMap& loss : map.maps("queue"))
    e.queue.push_back({.counted = loss.integer("counted", 0, kMost),
                       .missing = loss.integer("missing", 0, kMost),
                       .trailing = loss.flag("trailing")});
  return e;
}

struct Outcome {
  int code = -1;
  bool held = false;
  Experiment load, loss;
};

// Nothing is set where the run itself failed, which the caller has been told.
Outcome run_once() {
  const char* program = std::getenv("PITWALL_BENCH_PROGRAM");
  const auto folder = transport::TemporaryFolder::create("pitwall-gateway-test-");
  if (program == nullptr || !folder) {
    ADD_FAILURE() << "PITWALL_BENCH_PROGRAM is not set, or no temporary folder";
    return {};
  }
  const std::string json = folder->path() + "/gateway.json";
  Outcome outcome;
  auto process = transport::Process::spawn(
      {.argv = {program, "bench", "gateway", "--seconds", "5", "--json", json},
       .folder = PITWALL_SOURCE_DIR});
  if (process) outcome.code = process->wait().shell_code();
  const auto document = yaml::load_file(json);
  EXPECT_TRUE(document) << (document ? "" : to_string(document.error()));
  if (!document) return outcome;
  yaml::StrictMap root = document->root();
  outcome.held = root.flag("held");
  outcome.load = read_experiment(root.map("load"));
  outcome.loss = read_experiment(root.map("loss"));
  return outcome;
}

void expect_nothing_lost(const Experiment& e) {
  EXPECT_GE(e.sent, 5 * 27'000);
  EXPECT_EQ(e.car_received, e.sent);
  EXPECT_EQ(e.listener_received, e.sent);
  ASSERT_EQ(e.queue.size(), 4u) << "three pauses and the end";
  for (const Queue& loss : e.queue) {
    EXPECT_EQ(loss.counted, loss.missing);
    EXPECT_GT(loss.counted, 0);
  }
}

void expect_every_omission_reported(const Judged& judged) {
  EXPECT_GT(judged.omitted, 40);
  EXPECT_EQ(judged.reported, judged.omitted);
  EXPECT_EQ(judged.in_time, judged.omitted);
  EXPECT_EQ(judged.twice, 0);
  EXPECT_EQ(judged.false_reports, 0);
}

TEST(GatewayLoad, NothingIsLostAndWhatIsLeftOutIsReported) {
  const Outcome outcome = run_once();
  ASSERT_TRUE(outcome.code == 0 || outcome.code == 1) << outcome.code;
  EXPECT_EQ(outcome.code == 0, outcome.held);
  expect_nothing_lost(outcome.load);
  expect_nothing_lost(outcome.loss);
  EXPECT_EQ(outcome.load.by_car.omitted, 0);
  EXPECT_GT(outcome.loss.by_listener.reported, 0);
  ASSERT_TRUE(testing::in_time(outcome.loss.latest, kQuiet)) << "for a wake-up of the bench";
  expect_every_omission_reported(outcome.loss.by_car);
  expect_every_omission_reported(outcome.loss.by_listener);
}

}  // namespace
}  // namespace pitwall

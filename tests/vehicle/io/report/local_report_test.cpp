// SPDX-License-Identifier: Apache-2.0
#include "vehicle/io/report/local_report.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "protocol/transport/clock.hpp"
#include "tests/support/comes_true.hpp"

namespace pitwall::io {
namespace {

using telemetry::field;
using telemetry::Group;

TEST(LocalReport, IsTheSnapshotAtAPortOfThisMachine) {
  auto listener = transport::UdpSocket::bind({});
  ASSERT_TRUE(listener);
  auto report = LocalReport::open(listener->local().port, telemetry::Source::kSimulation);
  ASSERT_TRUE(report);
  EXPECT_TRUE(report->on());
  const Instant now = transport::monotonic_now();
  telemetry::Snapshot snapshot;
  snapshot.values[field("ego.vx")] = 33.0;
  snapshot.at(Group::kEgo) = now - milliseconds(7);
  report->send(snapshot, now);
  report->send(snapshot, now);
  std::vector<telemetry::StatePacket> received;
  std::vector<transport::UdpDatagram> inbox(8);
  EXPECT_TRUE(testing::comes_true([&] {
    const std::size_t count = listener->receive(inbox);
    for (std::size_t i = 0; i < count; ++i) {
      EXPECT_EQ(inbox[i].from.ip, kLoopbackIp);
      received.push_back(*telemetry::parse(inbox[i].payload()));
    }
    return received.size() == 2;
  }));
  ASSERT_EQ(received.size(), 2u);
  EXPECT_EQ(received[0].values[field("ego.vx")], 33.0);
  EXPECT_EQ(received[0].age_of(Group::kEgo), milliseconds(7));
  EXPECT_EQ(received[1].sequence, received[0].sequence + 1);
  EXPECT_EQ(received[1].run, received[0].run);
  EXPECT_EQ(received[0].source, telemetry::Source::kSimulation);
}

TEST(LocalReport, WithoutAPortNobodyIsTold) {
  auto report = LocalReport::open(0, telemetry::Source::kCar);
  ASSERT_TRUE(report);
  EXPECT_FALSE(report->on());
  report->send({}, transport::monotonic_now());
}

}  // namespace
}  // namespace pitwall::io

// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/live/car_summary.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "protocol/transport/file.hpp"
#include "vehicle/io/receiver_port.hpp"
#include "vehicle/io/report/radio_summary.hpp"
#include "vehicle/io/report/tally.hpp"
#include "vehicle/io/report/tracking_summary.hpp"

namespace pitwall::bench {
namespace {

class CarSummaryFile : public ::testing::Test {
 protected:
  std::string write(const std::string& text) {
    const std::string path = folder_->path() + "/vehicle.json";
    EXPECT_TRUE(transport::write_file(path, text));
    return path;
  }
  std::string refusal(const std::string& text) {
    const auto summary = read_car_summary(write(text));
    return summary ? "" : to_string(summary.error());
  }

  Result<transport::TemporaryFolder, Problem> folder_ =
      transport::TemporaryFolder::create("pitwall-summary-");
};

// Every count has its own value, so that none can be taken for another.
io::FrameTotals some_totals() {
  io::FrameTotals frames;
  frames.received = 101;
  frames.sent = 102;
  frames.tx_drops = 103;
  frames.rx_dropped = 104;
  frames.gate_refusals = 105;
  frames.missed_shifts = 116;
  for (std::size_t i = 0; i < frames.gate_verdicts.size(); ++i) frames.gate_verdicts[i] = 200 + i;
  return frames;
}

world::BusHealth some_health() {
  world::BusHealth bus;
  bus.frames_applied = 106;
  bus.frames_lost = 107;
  bus.refused = {.unknown_id = 1,
                 .wrong_length = 2,
                 .remote_or_error = 3,
                 .stuck_counter = 4,
                 .jumped_counter = 5,
                 .wrong_checksum = 6,
                 .not_finite = 7,
                 .out_of_range = 8,
                 .implausible_slew = 9};
  bus.identity = {.verdict = world::IdentityVerdict::kWrong,
                  .difference = world::IdentityDifference::kUnknownId,
                  .id = 1000,
                  .received = 8};
  bus.link = {.controller = world::ControllerState::kBusOff, .lost_in_socket = 108};
  for (const std::uint32_t id : {1300U, 1303U})
    EXPECT_TRUE(bus.messages.push({.id = id,
                                   .liveness = world::Liveness::kAlive,
                                   .debt = 3,
                                   .lost = id + 1,
                                   .late = id + 3,
                                   .bad = id + 2,
                                   .mean_interval = milliseconds(5),
                                   .last = {77}}));
  for (const auto detector : {world::LossDetector::kCounter, world::LossDetector::kPeriod,
                              world::LossDetector::kSocketQueue, world::LossDetector::kInterface})
    EXPECT_TRUE(bus.losses.push({.id = static_cast<std::uint32_t>(detector),
                                 .detector = detector,
                                 .frames = 2,
                                 .due = {1'000'000'007},
                                 .noticed = {1'000'000'009}}));
  return bus;
}

telemetry::LinkReport some_report() {
  telemetry::LinkReport report;
  report.sessions = 3;
  report.association.opened = 4;
  report.association.refused[0] = 5;
  report.bad_bodies[1] = 6;
  report.bad_records = 7;
  report.round_trip = milliseconds(31);
  report.ledger.received = 8;
  report.ledger.decided[1] = 9;
  report.paths[1].received.received = 10;
  report.paths[1].spent.bytes = 11;
  return report;
}

std::string some_summary(const io::StepTally& tally) {
  io::LossTally losses;
  losses.add(some_health());
  return io::summary_json(tally, some_totals(), some_health(), losses,
                          {.radio = io::radio_json(some_report(), 2)});
}

TEST_F(CarSummaryFile, IsReadAsTheCarWroteIt) {
  io::StepTally tally;
  for (int i = 0; i < 98; ++i) tally.add(microseconds(20), microseconds(7), 0);
  tally.add(microseconds(60), microseconds(300), 2);
  tally.add(microseconds(90), microseconds(300), 1);
  const auto car = read_car_summary(write(some_summary(tally)));
  ASSERT_TRUE(car) << to_string(car.error());
  EXPECT_EQ(car->ticks, 100u);
  EXPECT_EQ(car->missed_deadlines, 3u);
  EXPECT_EQ(car->frames_received, 101u);
  EXPECT_EQ(car->frames_sent, 102u);
  EXPECT_EQ(car->tx_drops, 103u);
  EXPECT_EQ(car->rx_dropped, 104u);
  EXPECT_EQ(car->gate_refusals, 105u);
  EXPECT_EQ(car->missed_shifts, 116u);
  EXPECT_EQ(car->frames_refused, 45u);
  EXPECT_EQ(car->step_p50_us, tally.quantile_us(0.5));
  EXPECT_EQ(car->step_p99_us, tally.quantile_us(0.99));
  EXPECT_EQ(car->step_max_us, tally.max_us());
  EXPECT_EQ(car->tick_late_p50_us, 8.0);
  EXPECT_EQ(car->tick_late_p99_us, 301.0);

  ASSERT_EQ(car->refused_by_kind.size(), 9u);
  EXPECT_EQ(car->refused_by_kind[0], (std::pair<std::string, std::uint64_t>{"unknown_id", 1}));
  EXPECT_EQ(car->refused_by_kind[8],
            (std::pair<std::string, std::uint64_t>{"implausible_slew", 9}));
  EXPECT_EQ(car->gate_verdicts.size(), safety::kVerdicts);
}

TEST_F(CarSummaryFile, ItsDetectionsAndTheCarsThatItTracksAreReadAsItHadThem) {
  tracking::Counters counters;
  counters.frames = 9, counters.too_far = 3;
  world::Opponents opponents;
  ASSERT_TRUE(opponents.cars.push(
      {.id = 1, .x_m = -1.5, .y_m = 2.5, .speed_mps = 40.0, .measured_at = opponents.at}));
  const std::string sensors = R"([{"name": "image", "samples": 1000, "refused": 1000},
      {"name": "lidar", "samples": 1, "refused": 2, "in_future": 4, "too_old": 8,
       "foreign_frames": 16, "too_many": 32, "no_room": 64, "bad_detections": 128},
      {"name": "radar", "samples": 256, "bad_detections": 0}])";
  const auto car = read_car_summary(write(
      io::summary_json({}, some_totals(), some_health(), {},
                       {.sensors = sensors, .tracking = io::tracking_json(counters, opponents)})));
  ASSERT_TRUE(car) << to_string(car.error());
  EXPECT_EQ(car->tracking.size(), 15U);
  EXPECT_EQ(car->tracking[0], (std::pair<std::string, std::uint64_t>{"frames", 9}));
  ASSERT_EQ(car->opponents.size(), 1U);
  EXPECT_EQ(car->opponents[0].x_m, -1.5);
  EXPECT_EQ(car->opponents[0].y_m, 2.5);
  EXPECT_EQ(car->opponents[0].speed_mps, 40.0);
  EXPECT_EQ(detections_received(*car), 256U + 63U) << "what found no room did not reach the loop";
}

TEST_F(CarSummaryFile, ItsReceiversAreReadAsTheCarHadThem) {
  std::vector<io::ReceiverPort> ports;
  for (const auto kind : {world::ReceiverKind::kNovatelOem7, world::ReceiverKind::kVectorNav}) {
    auto port = io::ReceiverPort::open(io::UdpReceiver{}, 0, {.kind = kind});
    ASSERT_TRUE(port);
    ports.push_back(*std::move(port));
  }
  const std::string text =
      io::summary_json({}, some_totals(), some_health(), {},
                       {.receivers = io::receivers_json(ports),
                        .recorder = R"({"records": 5, "dropped": 2})",
                        .sensors = R"([{"name": "lidar_front", "expected_hz": 20.000,
                                        "samples": 7}])"});
  const auto car = read_car_summary(write(text));
  ASSERT_TRUE(car) << to_string(car.error()) << text;
  EXPECT_EQ(car->recorder, (CarSummary::Counts{{"records", 5}, {"dropped", 2}}));
  ASSERT_EQ(car->sensors.size(), 1u);
  EXPECT_EQ(car->sensors[0].name, "lidar_front");
  EXPECT_EQ(car->sensors[0].counts, (CarSummary::Counts{{"samples", 7}}));
  ASSERT_EQ(car->receivers.size(), 2u);
  EXPECT_EQ(car->receivers[0].kind, "novatel_oem7");
  EXPECT_EQ(car->receivers[1].kind, "vectornav");
  EXPECT_EQ(car->receivers[0].link, "udp:127.0.0.1:0");
  const auto has = [&](const char* name) {
    return std::ranges::any_of(car->receivers[0].counts,
                               [&](const auto& count) { return count.first == name; });
  };
  for (const char* name :
       {"bytes", "bad_checksum", "positions", "stamps_frozen", "negative standard deviation"})
    EXPECT_TRUE(has(name)) << name;
}

TEST_F(CarSummaryFile, ItsRadioIsReadAsTheCarHadIt) {
  const auto car = read_car_summary(write(some_summary({})));
  ASSERT_TRUE(car) << to_string(car.error());
  const auto has = [](const CarSummary::Counts& counts, const char* name, std::uint64_t value) {
    return std::ranges::find(counts, std::pair<std::string, std::uint64_t>{name, value}) !=
           counts.end();
  };
  EXPECT_TRUE(has(car->radio, "sessions", 3));
  EXPECT_TRUE(has(car->radio, "opened", 4));
  EXPECT_TRUE(has(car->radio, "bad_bodies", 13));
  EXPECT_TRUE(has(car->radio, "round_trip_us", 31'000));
  EXPECT_EQ(car->radio_refused.size(), telemetry::kRefusals);
  EXPECT_EQ(car->radio_refused[0].second, 5u);
  EXPECT_TRUE(has(car->radio_commands, "received", 8));
  EXPECT_TRUE(has(car->radio_commands, "applied", 9));
  ASSERT_EQ(car->radio_paths.size(), 2u);
  EXPECT_TRUE(has(car->radio_paths[1], "received", 10));
  EXPECT_TRUE(has(car->radio_paths[1], "sent_bytes", 11));
  io::LossTally none;
  const auto without =
      read_car_summary(write(io::summary_json({}, some_totals(), some_health(), none)));
  ASSERT_TRUE(without) << to_string(without.error());
  EXPECT_TRUE(without->radio.empty());
}

TEST_F(CarSummaryFile, ItsBusIsReadAsTheCarSawIt) {
  const auto car = read_car_summary(write(some_summary({})));
  ASSERT_TRUE(car) << to_string(car.error());
  EXPECT_EQ(car->frames_applied, 106u);
  EXPECT_EQ(car->frames_lost, 107u);
  EXPECT_EQ(car->loss_reports, 4u);
  EXPECT_EQ(car->controller, "bus_off");
  EXPECT_EQ(car->identity, "wrong");
  EXPECT_EQ(car->identity_sentence,
            "CAN id 1000: 8 bytes on the bus, no such message in database CAN1-INDY-V14");
  EXPECT_EQ(car->database.rfind("av21.dbc, CAN1-INDY-V14, fingerprint ", 0), 0u);
  EXPECT_EQ(car->link.front(), (std::pair<std::string, std::uint64_t>{"lost_in_socket", 108}));
  const world::BusHealth bus = some_health();
  ASSERT_EQ(car->messages.size(), bus.messages.size());
  for (std::size_t i = 0; i < bus.messages.size(); ++i) {
    EXPECT_EQ(car->messages[i].id, bus.messages[i].id);
    EXPECT_EQ(car->messages[i].liveness, "alive");
    EXPECT_EQ(car->messages[i].debt, bus.messages[i].debt);
    EXPECT_EQ(car->messages[i].lost, bus.messages[i].lost);
    EXPECT_EQ(car->messages[i].late, bus.messages[i].late);
    EXPECT_EQ(car->messages[i].bad, bus.messages[i].bad);
    EXPECT_EQ(car->messages[i].mean_interval, bus.messages[i].mean_interval);
    EXPECT_EQ(car->messages[i].last, bus.messages[i].last);
  }
  ASSERT_EQ(car->losses.size(), bus.losses.size());
  for (std::size_t i = 0; i < bus.losses.size(); ++i) {
    EXPECT_EQ(car->losses[i].id, bus.losses[i].id);
    EXPECT_EQ(car->losses[i].detector, bus.losses[i].detector);
    EXPECT_EQ(car->losses[i].frames, bus.losses[i].frames);
    EXPECT_EQ(car->losses[i].due, bus.losses[i].due);
    EXPECT_EQ(car->losses[i].noticed, bus.losses[i].noticed);
  }
}

TEST_F(CarSummaryFile, WhatIsCutOrStrangeIsRefusedWithItsPlace) {
  const std::string good = some_summary({});
  ASSERT_EQ(refusal(good), "");
  for (std::size_t length = 0; length + 2 < good.size(); length += 7)
    EXPECT_NE(refusal(good.substr(0, length)).find("vehicle.json"), std::string::npos) << length;

  const auto with = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    text.replace(text.find(from), from.size(), to);
    return refusal(text);
  };
  EXPECT_NE(with("\"ticks\": 0", "\"ticks\": -1").find("vehicle.json:1:"), std::string::npos);
  EXPECT_NE(with("\"ticks\": 0", "\"ticks\": 1.5").find("ticks"), std::string::npos);
  EXPECT_NE(with("\"ticks\"", "\"tacks\"").find("ticks"), std::string::npos);
  EXPECT_NE(with("\"stuck_counter\": 4", "\"stuck_counter\": many"), "");
  EXPECT_NE(with("\"gate_verdicts\"", "\"extra\": 1, \"gate_verdicts\""), "");
}

TEST_F(CarSummaryFile, AFileThatIsNotThereIsAProblem) {
  const auto car = read_car_summary(folder_->path() + "/none.json");
  ASSERT_FALSE(car);
  EXPECT_NE(to_string(car.error()).find("none.json"), std::string::npos);
}

// Reported missing and came after all: taken back. What the detector cannot name, and what was due
// after the end, is not of this figure; what one message got back pays for no other.
TEST(FramesThatNeverCame, AreThoseReportedLessThoseThatCameLate) {
  const auto reported = [](std::uint32_t id, std::uint32_t frames, std::int64_t due_s) {
    return world::LossReport{.id = id, .frames = frames, .due = Instant{} + seconds(due_s)};
  };
  CarSummary car;
  car.messages = {{.id = 1, .late = 14}, {.id = 2, .late = 1}, {.id = 3, .late = 9}};
  const Instant end = Instant{} + seconds(10);
  EXPECT_EQ(frames_that_never_came(car, end), 0u);
  car.losses = {reported(1, 9, 2), reported(1, 5, 3), reported(0, 100, 4)};
  EXPECT_EQ(frames_that_never_came(car, end), 0u);  // a noisy host: all came, late
  car.losses.push_back(reported(2, 3, 5));
  EXPECT_EQ(frames_that_never_came(car, end), 2u);
  car.losses.push_back(reported(3, 4, 10));
  EXPECT_EQ(frames_that_never_came(car, end), 2u);  // what message 3 has left over stays its own
  car.losses.push_back(reported(2, 7, 11));
  EXPECT_EQ(frames_that_never_came(car, end), 2u);  // due when the bench was silent
}

}  // namespace
}  // namespace pitwall::bench

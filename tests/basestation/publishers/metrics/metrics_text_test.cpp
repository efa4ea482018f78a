// SPDX-License-Identifier: Apache-2.0
#include "basestation/publishers/metrics/metrics_text.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "tests/support/oracle_node.hpp"

namespace pitwall::publishers::metrics {
namespace {

CarStatus status() {
  CarStatus status{.car = 7, .name = "Seven \"7\"", .mode = "HIL", .history_bytes = 4096};
  for (std::size_t place = 0; place < kNumbers; ++place) status.numbers[place] = 0.5;
  status.numbers[telemetry::field("ego.vx")] = 50.5;
  status.numbers[telemetry::field("ego.y")] = kUnset;
  status.numbers[telemetry::field("tyres.pressure_rear_left")] = 152.5;
  status.ages_s[telemetry::index_of(telemetry::Group::kEgo)] = 0.02;
  status.alarms = {{.priority = "high", .active = 2, .unacknowledged = 1}};
  status.counts = {{"packets", "packets of the car", 1'234}};
  status.refused = {{"bad tag", 3}};
  status.publishers = {{.publisher = "foxglove",
                        .sent = 9,
                        .failed = 0,
                        .clients = 1,
                        .dropped = {{"/car/ego", 4}},
                        .refused = {{"clientPublish", 2}}}};
  return status;
}

constexpr transport::BenchPause kPause{.now = milliseconds(250), .total = milliseconds(1'250)};

std::string text_of(const std::vector<CarStatus>& cars) {
  return metrics_text(cars, web::WebCounters{.joined = 3, .left = 1}, kPause);
}

bool has(const std::string& text, const std::string& line) {
  return text.find("\n" + line + "\n") != std::string::npos;
}

TEST(MetricsText, NumbersAreToldInBaseUnitsWithTheirPlaceInTheRegistry) {
  const std::string text = text_of({status()});
  EXPECT_TRUE(has(text, R"(pitwall_field_meters_per_second{car="7",group="ego",field="vx"} 50.5)"));
  EXPECT_TRUE(has(
      text, R"(pitwall_field_pascals{car="7",group="tyres",field="pressure_rear_left"} 152500)"));
  EXPECT_TRUE(has(text, R"(pitwall_field_seconds{car="7",group="link",field="rtt_ms"} 5e-04)"));
  EXPECT_TRUE(has(text, R"(pitwall_group_age_seconds{car="7",group="ego"} 0.02)"));
  EXPECT_TRUE(has(text, R"(pitwall_alarms{car="7",priority="high"} 2)"));
  EXPECT_TRUE(has(text, R"(pitwall_history_bytes{car="7"} 4096)"));
  EXPECT_TRUE(has(text, R"(pitwall_packets_total{car="7"} 1234)"));
  EXPECT_TRUE(has(text, R"(pitwall_datagrams_refused_total{car="7",why="bad tag"} 3)"));
  EXPECT_TRUE(has(
      text, R"(pitwall_publisher_dropped_total{car="7",publisher="foxglove",topic="/car/ego"} 4)"));
  EXPECT_TRUE(has(text, "pitwall_web_consoles 2"));
}

TEST(MetricsText, OnlyABaseThatGoesByBenchTimeSaysForHowLongItStood) {
  EXPECT_TRUE(has(text_of({}), "pitwall_bench_time_stood_seconds_total 1.25"));
  EXPECT_EQ(metrics_text({}, web::WebCounters{}).find("bench_time"), std::string::npos);
}

TEST(MetricsText, WhatIsNotKnownNowHasNoSample) {
  const std::string text = text_of({status()});
  EXPECT_EQ(text.find(R"(group="ego",field="y")"), std::string::npos);
  EXPECT_EQ(text.find(R"(age_seconds{car="7",group="tyres")"), std::string::npos);
  EXPECT_EQ(text.find("NaN"), std::string::npos);
}

TEST(MetricsText, TwoCarsShareTheirFamilies) {
  CarStatus other = status();
  other.car = 8;
  const std::string text = text_of({status(), other});
  EXPECT_TRUE(has(text, R"(pitwall_history_bytes{car="7"} 4096)"));
  EXPECT_TRUE(has(text, R"(pitwall_packets_total{car="8"} 1234)"));
  const std::string head = "# TYPE pitwall_packets_total";
  EXPECT_EQ(text.find(head), text.rfind(head));
}

TEST(MetricsText, PromtoolFindsNothingWrongWithIt) {
  const auto file = std::filesystem::temp_directory_path() /
                    ("pitwall_metrics_" + std::to_string(::getpid()) + ".txt");
  std::ofstream{file} << text_of({status()});
  const std::string output =
      testing::output_of("promtool check metrics < '" + file.string() + "' 2>&1");
  EXPECT_EQ(output, "");
  std::filesystem::remove(file);
}

}  // namespace
}  // namespace pitwall::publishers::metrics

// SPDX-License-Identifier: Apache-2.0
#include "protocol/dds/domain.hpp"

#include <gtest/gtest.h>

#include <mutex>

#include "protocol/transport/clock.hpp"

namespace pitwall::dds {
namespace {

using Sample = std::vector<std::uint8_t>;

// What came, in order; asked for by the test's thread.
class Received {
 public:
  Domain::Take take() {
    return [this](Bytes cdr) {
      const std::lock_guard hold(lock_);
      samples_.emplace_back(cdr.begin(), cdr.end());
    };
  }
  std::vector<Sample> all() const {
    const std::lock_guard hold(lock_);
    return samples_;
  }
  bool waits_for(std::size_t count) const {
    const Instant end = transport::monotonic_now() + seconds(30);
    while (all().size() < count && transport::monotonic_now() < end)
      transport::sleep_until(transport::monotonic_now() + milliseconds(5));
    return all().size() >= count;
  }

 private:
  mutable std::mutex lock_;
  std::vector<Sample> samples_;
};

template <class IsSo>
bool comes(const IsSo& is_so) {
  const Instant end = transport::monotonic_now() + seconds(30);
  while (!is_so() && transport::monotonic_now() < end)
    transport::sleep_until(transport::monotonic_now() + milliseconds(5));
  return is_so();
}

const TopicType kTopic{"rt/test", "test_msgs::msg::dds_::Bytes_"};
Sample sample_of(std::size_t bytes) {
  Sample sample{0, 1, 0, 0};
  for (std::size_t i = sample.size(); i < bytes; ++i)
    sample.push_back(static_cast<std::uint8_t>(i));
  return sample;
}

TEST(DdsDomain, WhatIsWrittenIsReadByteForByteWhateverItsSize) {
  auto here = Domain::join({.domain = 70}), there = Domain::join({.domain = 70});
  ASSERT_TRUE(here && there);
  Received received;
  auto writer = (*here)->write_to(kTopic, {.depth = 100});
  ASSERT_TRUE(writer);
  ASSERT_TRUE((*there)->read_from(kTopic, {.depth = 100}, received.take()));
  ASSERT_TRUE(comes([&] { return (*writer)->readers() == 1; }));
  const std::vector<Sample> wanted{sample_of(8), sample_of(5'000), sample_of(1'000'000),
                                   sample_of(12)};
  for (const Sample& sample : wanted) EXPECT_TRUE((*writer)->write(sample));
  ASSERT_TRUE(received.waits_for(wanted.size()));
  EXPECT_EQ(received.all(), wanted);
  EXPECT_EQ((*here)->figures().participants, 1U);
  EXPECT_NE((*here)->guid(), (*there)->guid());
}

TEST(DdsDomain, WhatIsLatchedIsKeptForWhoComesLater) {
  auto here = Domain::join({.domain = 71});
  ASSERT_TRUE(here);
  auto writer = (*here)->write_to(kTopic, {.latched = true, .depth = 1});
  ASSERT_TRUE(writer);
  EXPECT_TRUE((*writer)->write(sample_of(8)));
  EXPECT_TRUE((*writer)->write(sample_of(16)));
  auto there = Domain::join({.domain = 71});
  Received received;
  ASSERT_TRUE((*there)->read_from(kTopic, {.latched = true, .depth = 1}, received.take()));
  ASSERT_TRUE(received.waits_for(1));
  EXPECT_EQ(received.all(), (std::vector<Sample>{sample_of(16)})) << "the newest alone";
}

TEST(DdsDomain, AnotherTypeOrAnotherQualityIsNotConnectedAndIsCounted) {
  auto here = Domain::join({.domain = 72}), there = Domain::join({.domain = 72});
  ASSERT_TRUE(here && there);
  Received received;
  auto writer = (*here)->write_to(kTopic, {});
  auto quick = (*here)->write_to({"rt/quick", kTopic.type}, {.reliable = false});
  ASSERT_TRUE(writer && quick);
  ASSERT_TRUE(
      (*there)->read_from({kTopic.topic, "test_msgs::msg::dds_::Other_"}, {}, received.take()));
  ASSERT_TRUE((*there)->read_from({"rt/quick", kTopic.type}, {.reliable = true}, received.take()));
  EXPECT_TRUE(comes([&] {
    const DomainFigures figures = (*here)->figures();
    return figures.foreign_types == 1 && figures.foreign_qualities == 1;
  }));
  EXPECT_TRUE((*writer)->write(sample_of(8)) && (*quick)->write(sample_of(8)));
  EXPECT_EQ((*writer)->readers() + (*quick)->readers(), 0);
  EXPECT_TRUE(received.all().empty());
}

// Nothing waits for those that take nothing.
TEST(DdsDomain, AWriterWithoutReadersTakesEverything) {
  auto here = Domain::join({.domain = 73});
  ASSERT_TRUE(here);
  auto writer = (*here)->write_to(kTopic, {.latched = true, .depth = 1});
  ASSERT_TRUE(writer);
  for (int i = 0; i < 10'000; ++i) ASSERT_TRUE((*writer)->write(sample_of(100)));
}

TEST(DdsDomain, WhatCannotBeIsRefusedWithTheReason) {
  const auto why = [](const DomainConfig& config) {
    const auto got = Domain::join(config);
    return got ? std::string{"taken"} : to_string(got.error());
  };
  EXPECT_EQ(why({.domain = 102}), "DDS domain 102: error: expected 0 to 101");
  EXPECT_EQ(why({.domain = -1}), "DDS domain -1: error: expected 0 to 101");
  EXPECT_EQ(why({.interface = "wlan0"}), "DDS domain 0: error: wlan0 is not an IPv4 address");
  EXPECT_EQ(why({.peers = {"car7"}}), "DDS domain 0: error: car7 is not an IPv4 address");
  auto here = Domain::join({.domain = 74});
  ASSERT_TRUE(here);
  ASSERT_TRUE((*here)->write_to(kTopic, {}));
  EXPECT_FALSE((*here)->write_to(kTopic, {})) << "a topic has one writer here";
}

}  // namespace
}  // namespace pitwall::dds

// SPDX-License-Identifier: Apache-2.0
#include "basestation/publishers/recorder/journal.hpp"

#include <gtest/gtest.h>

#include <map>

#include "protocol/recorder/segment_folder.hpp"
#include "protocol/recording/mcap_reader.hpp"
#include "protocol/transport/file.hpp"
#include "tests/basestation/radio_rig.hpp"

namespace pitwall::recorder {
namespace {

TEST(Journal, KeepsStatesDatagramsAndItsOwnFigures) {
  const auto folder = transport::TemporaryFolder::create("pitwall_journal");
  {
    auto recorder = Recorder::start(folder->path(), {});
    ASSERT_TRUE(recorder);
    Journal journal{**recorder};
    RadioRig rig{{.real_car = false}};
    rig.station->observe(observer_of_datagrams(**recorder));
    rig.set(telemetry::fields_of(telemetry::Group::kEgo).first, 30.0);
    for (int i = 0; i < 100; ++i) {
      const std::uint64_t before = rig.station->rate().packets();
      rig.run(milliseconds(20));
      if (rig.station->rate().packets() != before)
        journal.packet(*rig.base, *rig.station->arrival());
      journal.publish(*rig.base, rig.now);
    }
  }
  std::map<std::string, int> messages;
  std::string texts;
  const auto file = transport::read_file(segments_of(folder->path())->front());
  recording::McapReader reader{{reinterpret_cast<const std::uint8_t*>(file->data()), file->size()}};
  while (const auto m = reader.next()) {
    ++messages[reader.channels().at(m->channel).topic];
    texts.append(reinterpret_cast<const char*>(m->data.data()), m->data.size());
  }
  EXPECT_EQ(messages["/base/recorder"], 2);
  EXPECT_GE(messages["/car/ego"], 20);
  EXPECT_GE(messages["/radio/down"], 30);
  EXPECT_GE(messages["/radio/up"], 5);
  EXPECT_FALSE(texts.empty());
}

}  // namespace
}  // namespace pitwall::recorder

// SPDX-License-Identifier: Apache-2.0
#include "basestation/outlets/recorder/journal.hpp"

#include <gtest/gtest.h>

#include <map>

#include "protocol/recorder/segment_folder.hpp"
#include "protocol/recording/mcap_reader.hpp"
#include "protocol/telemetry/delivery/event_content.hpp"
#include "protocol/transport/file.hpp"
#include "tests/basestation/radio_rig.hpp"

namespace pitwall::recorder {
namespace {

TEST(Journal, KeepsEventsCommandsAndTheLinkAsTheyHappen) {
  const auto folder = transport::TemporaryFolder::create("pitwall_journal");
  {
    auto recorder = Recorder::start(folder->path(), {});
    ASSERT_TRUE(recorder);
    Journal journal{**recorder, true};
    RadioRig rig{{.real_car = false}};
    rig.station->overhear(teller_of_datagrams(**recorder));
    rig.set(telemetry::fields_of(telemetry::Group::kEgo).first, 30.0);
    for (int i = 0; i < 100; ++i) {
      if (i == 50) {
        rig.car->log(telemetry::make_event(telemetry::TextEvent{"engine is warm"}, rig.now));
        EXPECT_TRUE(rig.station->obey("take 20", rig.now));
      }
      rig.run(milliseconds(20));
      journal.serve(*rig.station, rig.now);
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
  EXPECT_EQ(messages["/base/event"], 1);
  EXPECT_EQ(messages["/base/link"], 4);
  EXPECT_EQ(messages["/base/recorder"], 2);
  EXPECT_GE(messages["/base/hello"], 1);
  EXPECT_GE(messages["/radio/down"], 30);
  EXPECT_GE(messages["/radio/up"], 5);
  EXPECT_NE(texts.find("engine is warm"), std::string::npos);
  EXPECT_NE(texts.find(R"("mode": "HIL")"), std::string::npos);
}

}  // namespace
}  // namespace pitwall::recorder

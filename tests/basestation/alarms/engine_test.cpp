// SPDX-License-Identifier: Apache-2.0
#include "basestation/alarms/engine.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <sstream>

namespace pitwall::alarms {
namespace {

// The whole table over readings that a test sets; healthy ones at first.
struct AlarmRig {
  Engine engine;
  std::vector<Reading> readings = std::vector<Reading>(alarm_count());
  Situations situations;
  Instant now{seconds(100).ns};

  AlarmRig() {
    for (AlarmIndex i = 0; i < alarm_count(); ++i) set(i, false);
  }
  void set(AlarmIndex index, bool broken) {
    const AlarmSetting setting = engine.settings().of(index);
    const double out = setting.deadband + 1.0;
    const bool up = (alarm_row(index).side == Side::kAbove) == broken;
    readings[index] = {setting.limit + (up ? out : -out), true};
  }
  void set(std::string_view key, bool broken) { set(*find_alarm(key), broken); }
  void run(Duration length) {
    for (const Instant end = now + length; now < end;) {
      now += milliseconds(10);
      engine.step(readings, situations, now);
    }
  }
  std::optional<ListedAlarm> find(std::string_view key) const {
    for (const auto& list : {engine.active(), engine.shelved(), engine.suppressed()}) {
      for (const ListedAlarm& line : list)
        if (line.key == key) return line;
    }
    return std::nullopt;
  }
};

TEST(Engine, AHealthyCarIsSilent) {
  AlarmRig rig;
  rig.run(seconds(60));
  EXPECT_TRUE(rig.engine.active().empty());
  EXPECT_EQ(rig.engine.events(), 0U);
  EXPECT_EQ(rig.engine.revision(), 0U);
}

TEST(Engine, EveryAlarmComesOnItsOwn) {
  for (AlarmIndex i = 0; i < alarm_count(); ++i) {
    AlarmRig rig;
    rig.set(i, true);
    rig.run(seconds(10));
    const auto active = rig.engine.active();
    ASSERT_EQ(active.size(), 1U) << alarm_row(i).key;
    EXPECT_EQ(active.front().key, alarm_row(i).key);
    EXPECT_EQ(active.front().state, State::kUnack);
    EXPECT_TRUE(active.front().first_up);
    rig.set(i, false);
    rig.run(seconds(10));
    EXPECT_EQ(rig.engine.active().front().state, State::kReturnedUnack);
    EXPECT_TRUE(rig.engine.acknowledge(rig.engine.active().front().id, "Ada", rig.now).value());
    EXPECT_NE(rig.engine.state(i), State::kReturnedUnack);
  }
}

TEST(Engine, AReadingOfEachRowIsWantedElseItIsOurOwnMistake) {
  AlarmRig rig;
  rig.readings.pop_back();
  EXPECT_DEATH(rig.run(milliseconds(10)), "CHECK");
}

TEST(Engine, ALostLinkIsExactlyOneAlarm) {
  AlarmRig rig;
  rig.set("wheel_slip", true);
  rig.set("gnss_one_bad", true);
  rig.run(seconds(5));
  ASSERT_EQ(rig.engine.active().size(), 2U);
  rig.situations.set(Situation::kLinkLost, true);
  rig.set("link_lost", true);
  rig.set("link_degraded", true);
  for (AlarmIndex i = 0; i < alarm_count(); ++i) {
    if (alarm_row(i).silent_in.has(Situation::kLinkLost)) rig.set(i, true);
  }
  rig.run(seconds(30));
  ASSERT_EQ(rig.engine.active().size(), 1U);
  EXPECT_EQ(rig.engine.active().front().key, "link_lost");
  EXPECT_EQ(rig.engine.suppressed().size(), 2U);
  // Acknowledging the link acknowledges nothing that hides behind it.
  EXPECT_TRUE(rig.engine.acknowledge(rig.engine.active().front().id, "Ada", rig.now));
  EXPECT_FALSE(rig.engine.acknowledge(rig.find("wheel_slip")->id, "Ada", rig.now));
  rig.situations.set(Situation::kLinkLost, false);
  for (AlarmIndex i = 0; i < alarm_count(); ++i) rig.set(i, false);
  rig.run(seconds(10));
  EXPECT_EQ(rig.find("wheel_slip")->state, State::kReturnedUnack);
  EXPECT_FALSE(rig.find("link_lost"));
}

TEST(Engine, TheWorseOverrulesTheLesser) {
  AlarmRig rig;
  rig.set("off_line", true);
  rig.run(seconds(1));
  rig.set("off_line_far", true);
  rig.run(seconds(1));
  ASSERT_EQ(rig.engine.active().size(), 1U);
  EXPECT_EQ(rig.engine.active().front().key, "off_line_far");
  rig.set("off_line_far", false);
  rig.run(seconds(3));
  EXPECT_EQ(rig.find("off_line")->state, State::kUnack);  // still there, still unacknowledged
}

TEST(Engine, EachLesserOneIsOverruledByItsWorse) {
  int pairs = 0;
  for (AlarmIndex i = 0; i < alarm_count(); ++i) {
    const auto worse = find_alarm(alarm_row(i).overruled_by);
    if (!worse) continue;
    AlarmRig rig;
    rig.set(*worse, true);
    rig.run(seconds(10));
    rig.set(i, true);
    rig.run(seconds(10));
    EXPECT_EQ(rig.engine.state(i), State::kNormal) << alarm_row(i).key;
    ++pairs;
  }
  EXPECT_GT(pairs, 3);
}

TEST(Engine, ActsNameTheOccurrenceAndThePerson) {
  AlarmRig rig;
  rig.set("tyres_cold", true);
  rig.run(seconds(5));
  const AlarmId first = rig.find("tyres_cold")->id;
  rig.set("tyres_cold", false);
  rig.run(seconds(5));
  rig.set("tyres_cold", true);
  rig.run(seconds(5));
  const auto late = rig.engine.acknowledge(first, "Ada", rig.now);  // another has come since
  ASSERT_FALSE(late);
  EXPECT_EQ(to_string(late.error()), "alarm " + std::to_string(first) +
                                         ": error: is not in the list any more, or has come anew");
  const AlarmId second = rig.find("tyres_cold")->id;
  EXPECT_FALSE(rig.engine.acknowledge(second, "", rig.now));
  EXPECT_FALSE(rig.engine.acknowledge(0, "Ada", rig.now));
  EXPECT_FALSE(rig.engine.reset(second, "Ada", rig.now));
  EXPECT_TRUE(rig.engine.acknowledge(second, "Ada", rig.now));
  EXPECT_EQ(rig.engine.history().back().by, "Ada");
  EXPECT_EQ(rig.find("tyres_cold")->count, 2U);
}

TEST(Engine, AShelfHasAnEndAndAReason) {
  AlarmRig rig;
  rig.set("tyres_cold", true);
  rig.run(seconds(5));
  const AlarmId id = rig.find("tyres_cold")->id;
  EXPECT_FALSE(rig.engine.shelve(id, seconds(601), "Ada", "why", rig.now));
  EXPECT_FALSE(rig.engine.shelve(id, Duration{}, "Ada", "why", rig.now));
  EXPECT_FALSE(rig.engine.shelve(id, seconds(60), "Ada", "", rig.now));
  EXPECT_TRUE(rig.engine.shelve(id, seconds(60), "Ada", "warm-up", rig.now));
  EXPECT_EQ(rig.find("tyres_cold")->reason, "warm-up");
  rig.run(seconds(59));
  EXPECT_TRUE(rig.engine.active().empty());
  EXPECT_EQ(rig.engine.shelved().size(), 1U);
  EXPECT_TRUE(rig.engine.suppressed().empty()) << "by a person, not by the situation";
  rig.run(seconds(2));
  EXPECT_EQ(rig.find("tyres_cold")->state, State::kUnack);
  EXPECT_EQ(rig.engine.history().back().from, State::kShelved);
  EXPECT_TRUE(rig.engine.shelve(id, seconds(60), "Ada", "again", rig.now));
  EXPECT_TRUE(rig.engine.unshelve(id, "Ada", rig.now));
  EXPECT_EQ(rig.find("tyres_cold")->state, State::kAcked);
}

TEST(Engine, TheFirstOfAnEpisodeIsMarked) {
  AlarmRig rig;
  rig.set("battery_low", true);
  rig.run(seconds(5));
  rig.set("bus_off", true);
  rig.run(seconds(5));
  EXPECT_TRUE(rig.find("battery_low")->first_up);
  EXPECT_FALSE(rig.find("bus_off")->first_up);
  // Of two at once the more urgent.
  AlarmRig both;
  both.set("gnss_both_bad", true);
  both.set("link_degraded", true);
  both.run(seconds(5));
  EXPECT_EQ(both.engine.active().front().key, "gnss_both_bad");
}

TEST(Engine, OneThatComesAgainOrIsSeenKeepsItsPlaceInTheEpisode) {
  AlarmRig rig;
  rig.set("battery_low", true);
  rig.run(seconds(5));
  rig.set("bus_off", true);
  rig.run(seconds(5));
  ASSERT_TRUE(rig.engine.acknowledge(rig.find("battery_low")->id, "Ada", rig.now));
  EXPECT_TRUE(rig.find("battery_low")->first_up) << "still there";
  rig.set("battery_low", false);
  rig.run(seconds(10));
  EXPECT_FALSE(rig.find("battery_low"));
  rig.set("battery_low", true);
  rig.run(seconds(5));
  EXPECT_FALSE(rig.find("battery_low")->first_up) << "bus_off is older now";
  // The same for one that an act makes normal, and that comes again in the next look.
  AlarmRig seen_late;
  seen_late.set("relay", true);
  seen_late.run(seconds(1));
  EXPECT_TRUE(seen_late.find("relay")->first_up);
  seen_late.set("bus_off", true);
  seen_late.set("relay", false);
  seen_late.run(seconds(60));
  ASSERT_TRUE(seen_late.engine.acknowledge(seen_late.find("relay")->id, "Ada", seen_late.now));
  ASSERT_FALSE(seen_late.find("relay"));
  seen_late.set("relay", true);
  seen_late.run(milliseconds(10));
  ASSERT_TRUE(seen_late.find("relay"));
  EXPECT_FALSE(seen_late.find("relay")->first_up);
}

// Of those that come in the same look: the most urgent, then the first of the table.
TEST(Engine, OfTwoAtOnceOneIsTheFirst) {
  int pairs = 0;
  for (AlarmIndex a = 0; a < alarm_count(); ++a) {
    for (AlarmIndex b = a + 1; b < alarm_count(); ++b) {
      const AlarmRow &one = alarm_row(a), &other = alarm_row(b);
      if (one.on_delay != other.on_delay) continue;
      if (one.overruled_by == other.key || other.overruled_by == one.key) continue;
      AlarmRig rig;
      rig.set(a, true);
      rig.set(b, true);
      rig.run(one.on_delay + milliseconds(20));
      ASSERT_EQ(rig.engine.active().size(), 2U) << one.key << " " << other.key;
      const bool is_second = other.priority > one.priority;
      EXPECT_EQ(rig.find(one.key)->first_up, !is_second) << one.key << " " << other.key;
      EXPECT_EQ(rig.find(other.key)->first_up, is_second) << one.key << " " << other.key;
      ++pairs;
    }
  }
  EXPECT_GT(pairs, 20);
}

TEST(Engine, ANewComingIsNobodysAct) {
  AlarmRig rig;
  rig.set("tyres_cold", true);
  rig.run(seconds(5));
  const AlarmId id = rig.find("tyres_cold")->id;
  ASSERT_TRUE(rig.engine.shelve(id, kShelveMax, "Ada", "warm-up", rig.now));
  EXPECT_EQ(rig.find("tyres_cold")->shelved_until, rig.now + kShelveMax);
  ASSERT_TRUE(rig.engine.unshelve(id, "Bob", rig.now));
  EXPECT_EQ(rig.find("tyres_cold")->by, "Bob");
  EXPECT_EQ(rig.find("tyres_cold")->reason, "");
  rig.set("tyres_cold", false);
  rig.run(seconds(20));
  rig.set("tyres_cold", true);
  rig.run(seconds(5));
  EXPECT_GT(rig.find("tyres_cold")->id, id);
  EXPECT_EQ(rig.find("tyres_cold")->by, "");
}

TEST(Engine, OneThatComesOnTheShelfIsNotAnnounced) {
  AlarmRig rig;
  rig.set("tyres_cold", true);
  rig.run(seconds(5));
  const AlarmId id = rig.find("tyres_cold")->id;
  ASSERT_TRUE(rig.engine.shelve(id, seconds(120), "Ada", "warm-up", rig.now));
  rig.set("tyres_cold", false);
  rig.run(seconds(30));
  rig.set("tyres_cold", true);
  rig.run(seconds(30));
  EXPECT_EQ(rig.find("tyres_cold")->id, id);
  EXPECT_EQ(rig.engine.rate().ever(), 1U);
  // Nor is the reason of the shelf that of what comes when it is long over.
  rig.set("tyres_cold", false);
  rig.run(seconds(120));
  EXPECT_EQ(rig.find("tyres_cold")->reason, "warm-up");
  rig.set("tyres_cold", true);
  rig.run(seconds(5));
  EXPECT_GT(rig.find("tyres_cold")->id, id);
  EXPECT_EQ(rig.find("tyres_cold")->reason, "");
}

TEST(Engine, AnEpisodeBeginsWithItsOwn) {
  AlarmRig rig;
  rig.set("gnss_both_bad", true);
  rig.run(seconds(5));
  rig.set("gnss_both_bad", false);
  rig.run(seconds(60));
  ASSERT_TRUE(rig.engine.acknowledge(rig.find("gnss_both_bad")->id, "Ada", rig.now));
  ASSERT_EQ(rig.engine.count(), 0U);
  rig.set("battery_low", true);
  rig.run(seconds(5));
  EXPECT_TRUE(rig.find("battery_low")->first_up) << "though a more urgent one came before";
}

TEST(Engine, TheHistoryKeepsTheNewest) {
  AlarmRig rig;
  rig.set("tyres_cold", true);
  rig.run(seconds(5));
  const AlarmId id = rig.find("tyres_cold")->id;
  for (std::size_t i = 0; i < Engine::kHistory; ++i) {
    ASSERT_EQ(rig.engine.history().size(),
              std::min<std::uint64_t>(rig.engine.events(), Engine::kHistory));
    ASSERT_EQ(rig.engine.history().back().number, rig.engine.events());
    ASSERT_TRUE(i % 2 == 0 ? rig.engine.shelve(id, seconds(60), "Ada", "r", rig.now)
                           : rig.engine.unshelve(id, "Ada", rig.now));
  }
  EXPECT_EQ(rig.engine.history().size(), Engine::kHistory);
}

TEST(Engine, ASettingThatChangesIsARevision) {
  AlarmRig rig;
  AlarmEdit edit{.key = std::string(alarm_row(0).key),
                 .setting = rig.engine.settings().of(0),
                 .author = "Ada",
                 .reason = "r"};
  edit.setting.limit += 1.0;
  const std::uint64_t before = rig.engine.revision();
  ASSERT_TRUE(rig.engine.edit(edit));
  EXPECT_EQ(rig.engine.revision(), before + 1);
  edit.key = "none";
  ASSERT_FALSE(rig.engine.edit(edit));
  EXPECT_EQ(rig.engine.revision(), before + 1);
}

// Nothing but the time that passes ends it.
TEST(Engine, TheEndOfAFloodIsARevision) {
  AlarmRig rig;
  for (AlarmIndex i = 0; i < alarm_count(); ++i) rig.set(i, true);
  rig.run(seconds(10));
  ASSERT_TRUE(rig.engine.rate().flood());
  while (rig.engine.rate().flood()) {
    const std::uint64_t before = rig.engine.revision(), events = rig.engine.events();
    rig.now += seconds(1);
    rig.engine.step(rig.readings, rig.situations, rig.now);
    ASSERT_EQ(rig.engine.events(), events);
    EXPECT_EQ(rig.engine.revision(), before + (rig.engine.rate().flood() ? 0 : 1));
  }
}

TEST(Engine, AFloodShowsTheFirstAndTheHighOnly) {
  AlarmRig rig;
  rig.set("battery_low", true);
  rig.run(seconds(5));
  for (AlarmIndex i = 0; i < alarm_count(); ++i) rig.set(i, true);
  rig.run(seconds(10));
  ASSERT_TRUE(rig.engine.rate().flood());
  for (const ListedAlarm& line : rig.engine.active()) {
    const bool shown = line.priority == Priority::kHigh || line.key == "battery_low";
    EXPECT_EQ(line.flooded, !shown) << line.key;
  }
}

// Random values, situations, silences and acts over the whole table.
struct Storm {
  AlarmRig rig;
  std::mt19937 random;
  std::map<AlarmId, AlarmIndex> unseen_high;  // occurrences that nobody has seen

  explicit Storm(unsigned seed) : random(seed) {}
  std::size_t draw(std::size_t below) { return random() % below; }

  void act() {
    std::vector<ListedAlarm> lines = rig.engine.active();
    for (const ListedAlarm& line : rig.engine.shelved()) lines.push_back(line);
    for (const ListedAlarm& line : rig.engine.suppressed()) lines.push_back(line);
    if (lines.empty()) return;
    const AlarmId id = lines[draw(lines.size())].id;
    switch (draw(4)) {
      case 0:
        if (rig.engine.acknowledge(id, "Ada", rig.now)) unseen_high.erase(id);
        break;
      case 1:
        (void)rig.engine.shelve(id, seconds(1 + static_cast<std::int64_t>(draw(20))), "Ada", "r",
                                rig.now);
        break;
      case 2:
        if (rig.engine.unshelve(id, "Ada", rig.now)) unseen_high.erase(id);
        break;
      default:
        (void)rig.engine.reset(id, "Ada", rig.now);
    }
  }
  void world() {
    const AlarmIndex index = draw(alarm_count());
    switch (draw(6)) {
      case 0:
        rig.readings[index].usable = !rig.readings[index].usable;
        break;
      case 1: {
        const auto situation = static_cast<Situation>(draw(kSituations));
        rig.situations.set(situation, draw(2) == 0);
        break;
      }
      default:
        rig.set(index, draw(2) == 0);
    }
  }
  void step() {
    draw(3) == 0 ? act() : world();
    const std::uint64_t before = rig.engine.events();
    rig.run(milliseconds(10 + 10 * static_cast<std::int64_t>(draw(100))));
    for (const AlarmEvent& event : rig.engine.history()) {
      if (event.number <= before || event.to != State::kUnack) continue;
      const AlarmIndex index = *find_alarm(event.key);
      // The occurrence before is part of this one: the line has one id.
      std::erase_if(unseen_high, [&](const auto& one) { return one.second == index; });
      if (alarm_row(index).priority == Priority::kHigh) unseen_high[event.id] = index;
    }
  }
};

TEST(Engine, NoOrderOfEventsLosesAnUnseenHighAlarm) {
  for (unsigned seed = 0; seed < 30; ++seed) {
    Storm storm{seed};
    for (int i = 0; i < 200; ++i) {
      storm.step();
      for (const auto& [id, index] : storm.unseen_high) {
        const auto line = storm.rig.find(alarm_row(index).key);
        ASSERT_TRUE(line) << "seed " << seed << ": " << alarm_row(index).key;
        ASSERT_EQ(line->id, id) << "seed " << seed << ": " << alarm_row(index).key;
        ASSERT_NE(line->state, State::kAcked) << "seed " << seed << ": " << line->key;
        ASSERT_NE(line->state, State::kLatched) << "seed " << seed << ": " << line->key;
      }
    }
  }
}

// The history tells how every state came about.
TEST(Engine, TheHistoryIsAChain) {
  for (unsigned seed = 100; seed < 110; ++seed) {
    Storm storm{seed};
    std::map<std::string_view, State> states;
    std::uint64_t seen = 0;
    for (int i = 0; i < 200; ++i) {
      storm.step();
      for (const AlarmEvent& event : storm.rig.engine.history()) {
        if (event.number <= seen) continue;
        ASSERT_EQ(event.number, seen + 1);
        seen = event.number;
        ASSERT_EQ(states[event.key], event.from) << event.key;
        states[event.key] = event.to;
      }
    }
    for (AlarmIndex i = 0; i < alarm_count(); ++i) {
      EXPECT_EQ(storm.rig.engine.state(i), states[alarm_row(i).key]);
    }
  }
}

// All of a list but its values, as a console is told it.
std::string list_text(const Engine& engine) {
  std::ostringstream text;
  for (const auto& list : {engine.active(), engine.shelved(), engine.suppressed()}) {
    for (const ListedAlarm& a : list)
      text << a.key << a.id << text_of(a.state) << a.count << a.first_up << a.folded << a.flooded
           << a.by << a.reason << (a.shelved_until ? a.shelved_until->ns : 0) << "\n";
    text << "\n";
  }
  return text.str();
}

TEST(Engine, TheListIsInOrderCountedAndNeverChangesUnsaid) {
  for (unsigned seed = 40; seed < 44; ++seed) {
    Storm storm{seed};
    const Engine& engine = storm.rig.engine;
    std::string before = list_text(engine);
    std::uint64_t revision = engine.revision();
    for (int i = 0; i < 200; ++i) {
      storm.step();
      const auto lines = engine.active();
      for (std::size_t n = 1; n < lines.size(); ++n) {
        const ListedAlarm &a = lines[n - 1], &b = lines[n];
        ASSERT_TRUE(a.priority > b.priority || (a.priority == b.priority && a.id < b.id)) << n;
      }
      ASSERT_EQ(engine.count(), lines.size());
      for (const Priority p : {Priority::kLow, Priority::kMedium, Priority::kHigh}) {
        const auto of_it = [&](bool unacknowledged) {
          return static_cast<std::size_t>(std::ranges::count_if(lines, [&](const ListedAlarm& a) {
            const bool is_unseen = a.state == State::kUnack || a.state == State::kReturnedUnack;
            return a.priority == p && (is_unseen || !unacknowledged);
          }));
        };
        ASSERT_EQ(engine.count(p), of_it(false));
        ASSERT_EQ(engine.unacknowledged(p), of_it(true));
      }
      ASSERT_GE(engine.revision(), revision);
      const std::string now = list_text(engine);
      ASSERT_TRUE(now == before || engine.revision() > revision) << before << now;
      before = now;
      revision = engine.revision();
    }
  }
}

TEST(Engine, TheSameInputsGiveTheSameList) {
  for (unsigned seed = 7; seed < 10; ++seed) {
    Storm a{seed}, b{seed};
    for (int i = 0; i < 150; ++i) {
      a.step();
      b.step();
    }
    EXPECT_EQ(a.rig.engine.history(), b.rig.engine.history());
    EXPECT_EQ(a.rig.engine.revision(), b.rig.engine.revision());
    EXPECT_GT(a.rig.engine.events(), 20U);
  }
}

}  // namespace
}  // namespace pitwall::alarms

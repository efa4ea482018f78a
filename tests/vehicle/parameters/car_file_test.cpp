// SPDX-License-Identifier: Apache-2.0
#include "vehicle/parameters/car_file.hpp"

#include <gtest/gtest.h>

#include <string>

#include "tests/vehicle/parameters/mutation.hpp"

namespace pitwall::parameters {
namespace {

using testing::av21;
using testing::Piece;
using testing::refusal;
using testing::replaced;

TEST(CarFile, TheCarThatShipsIsRead) {
  const auto car = read_car(av21(), "av21.yaml");
  ASSERT_TRUE(car) << to_string(car.error());
  EXPECT_EQ(car->name, "AV-21");
  EXPECT_EQ(car->database, "av21");
  EXPECT_EQ(car->params.rates.tick, milliseconds(10));
  EXPECT_EQ(car->params.rates.planning, milliseconds(50));
  EXPECT_EQ(car->params.outbound.tick, car->params.rates.tick) << "one tick, said once";
  EXPECT_EQ(car->params.supervisor.steering_ratio, car->params.outbound.steering_ratio);
}

// The mutations below are worth what they find: the file has about 240 numbers.
TEST(CarFile, TheMutationsSeeTheWholeFile) {
  EXPECT_GT(testing::numbers(av21()).size(), 200u);
  EXPECT_GT(testing::keys(av21()).size(), 150u);
  EXPECT_GT(testing::lines(av21()).size(), 150u);
}

TEST(CarFile, EveryNumberIsRefusedWithItsLineWhenItIsWrong) {
  const auto check = [](const Piece& number, const std::string& bad, const std::string& place) {
    const std::string why = refusal(replaced(av21(), number, bad));
    ASSERT_EQ(why.rfind(place, 0), 0u)
        << "line " << number.line << ": " << number.text << " -> " << bad << ": " << why;
  };
  std::size_t n = 0;
  for (const Piece& number : testing::numbers(av21())) {
    const std::string place = "car.yaml:" + std::to_string(number.line) + ":";
    for (const char* bad : {"1e30", "-1e30"}) check(number, bad, place);
    if (++n % 5 != 0) continue;  // these do not depend on the number's range
    for (const char* bad :
         {".nan", ".inf", "-.inf", "nan", "many", "\"1\"", "~", "[]", "{}", "1.2.3", "0x", "1e999"})
      check(number, bad, place);
    check(number, "", "car.yaml:");  // its place is where the next thing is written
  }
}

TEST(CarFile, EveryFlagIsRefusedWithItsLineWhenItIsNeitherTrueNorFalse) {
  int seen = 0;
  for (const Piece& line : testing::lines(av21()))
    for (const char* flag : {"true", "false"}) {
      const std::size_t at = line.text.find(flag);
      if (at == std::string::npos) continue;
      const Piece value{line.from + at, line.from + at + std::string(flag).size(), line.line, flag};
      for (const char* bad : {"maybe", "1", "yes", "True", ".nan"})
        EXPECT_EQ(refusal(replaced(av21(), value, bad))
                      .rfind("car.yaml:" + std::to_string(line.line) + ":", 0),
                  0u)
            << line.text << " -> " << bad;
      ++seen;
    }
  EXPECT_EQ(seen, 6);
}

TEST(CarFile, EveryListMayBeNeitherShorterNorLonger) {
  for (const Piece& number : testing::numbers(av21())) {
    if (av21()[number.from - 1] != '[') continue;
    const std::string longer = replaced(av21(), number, number.text + ", " + number.text);
    const std::string place = "car.yaml:" + std::to_string(number.line) + ":";
    ASSERT_EQ(refusal(longer).rfind(place, 0), 0u) << "line " << number.line;
    const Piece with_comma{number.from, av21().find(' ', number.from) + 1, number.line, ""};
    ASSERT_EQ(refusal(replaced(av21(), with_comma, "")).rfind(place, 0), 0u)
        << "line " << number.line << ": " << refusal(replaced(av21(), with_comma, ""));
  }
}

TEST(CarFile, EveryKeyIsRefusedByNameWhenItIsMisspelt) {
  for (const Piece& key : testing::keys(av21())) {
    const std::string why = refusal(replaced(av21(), key, key.text + "x"));
    ASSERT_NE(why.find(key.text), std::string::npos) << "line " << key.line << ": " << why;
    ASSERT_EQ(why.rfind("car.yaml:", 0), 0u) << why;
  }
}

TEST(CarFile, EveryKeyIsRefusedWhenItIsRepeated) {
  for (const Piece& line : testing::lines(av21())) {
    if (line.text.find(':') == std::string::npos || line.text.find("- {") != std::string::npos)
      continue;
    if (line.text.find_last_not_of(' ') == line.text.rfind(':')) continue;  // opens a section
    const std::string twice = av21().substr(line.from, line.to - line.from) +
                              av21().substr(line.from, line.to - line.from);
    const std::string why = refusal(replaced(av21(), line, twice));
    ASSERT_EQ(why.rfind("car.yaml:" + std::to_string(line.line + 1) + ":", 0), 0u)
        << line.text << ": " << why;
  }
}

// A row of the watchdog may be missing: it has the limits of its module then. Without its only row
// the section is no mapping any more, which is refused as well.
TEST(CarFile, EveryLineIsNeeded) {
  for (const Piece& line : testing::lines(av21())) {
    if (line.text.find("priorities:") != std::string::npos) continue;  // may be left out
    const std::string why = refusal(replaced(av21(), line, ""));
    ASSERT_EQ(why.rfind("car.yaml:", 0), 0u) << "line " << line.line << ": " << line.text;
  }
  EXPECT_EQ(
      refusal(testing::with(av21(), "radio: {watched: true, warning_s: 1.0, bad_s: 3.0}", "{}")),
      "");
}

TEST(CarFile, ATornFileIsRefusedOrReadNeverMore) {
  std::size_t read = 0;
  const std::string& text = av21();
  for (std::size_t length = 0; length < text.size(); length += 50)
    read += refusal(text.substr(0, length)).empty() ? 1U : 0U;
  EXPECT_EQ(read, 0u) << "the last section is needed to its end";
  for (std::size_t from = 50; from < text.size(); from += 50) (void)refusal(text.substr(from));
}

TEST(CarFile, DamagedBytesAreRefusedOrReadNeverMore) {
  std::uint64_t state = 1;
  for (int i = 0; i < 400; ++i) {
    std::string text = av21();
    for (int n = 0; n < 3; ++n) {
      state = state * 6364136223846793005ULL + 1442695040888963407ULL;
      text[(state >> 33U) % text.size()] = static_cast<char>(state >> 25U);
    }
    const std::string why = refusal(text);
    if (!why.empty()) {
      ASSERT_EQ(why.rfind("car.yaml", 0), 0u) << why;
    }
  }
}

TEST(CarFile, RefusesWhatIsNoCar) {
  for (const char* text :
       {"", "\n", "# nothing\n", "[]", "1", "a: b", "---\n---\n", "\t", "{", "a"})
    EXPECT_EQ(refusal(text).rfind("car.yaml", 0), 0u) << text << ": " << refusal(text);
}

TEST(CarFile, RefusesAnotherSchemaAndAnotherDatabase) {
  EXPECT_NE(refusal(testing::with(av21(), "schema: 1", "schema: 2")).find("car.yaml:3:"),
            std::string::npos);
  const std::string why = refusal(testing::with(av21(), "database: av21", "database: av24"));
  EXPECT_NE(why.find("car.yaml:5:"), std::string::npos) << why;
  EXPECT_NE(why.find("av24"), std::string::npos) << why;
}

}  // namespace
}  // namespace pitwall::parameters

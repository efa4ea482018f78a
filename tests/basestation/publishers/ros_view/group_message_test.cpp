// SPDX-License-Identifier: Apache-2.0
#include "basestation/publishers/ros_view/group_message.hpp"

#include <gtest/gtest.h>

#include <regex>
#include <set>

#include "tests/support/ros_oracle.hpp"

namespace pitwall::publishers::ros_view {
namespace {

using telemetry::Group;

TEST(GroupMessage, NamesFollowTheRulesOfRos) {
  EXPECT_EQ(message_name("opponent_1"), "Opponent1");
  EXPECT_EQ(message_name("steering_unit"), "SteeringUnit");
  EXPECT_EQ(constant_name("ct_state", "race ready"), "CT_STATE_RACE_READY");
  EXPECT_EQ(constant_name("reason", "-"), "REASON_NONE");
  EXPECT_EQ(constant_name("arming", "REFUSED: the car moves"), "ARMING_REFUSED_THE_CAR_MOVES");
  // rosidl_adapter/parser.py: is_valid_message_name, is_valid_field_name, is_valid_constant_name.
  const std::regex message_rule{"[A-Z][A-Za-z0-9]*"}, constant_rule{"[A-Z]([A-Z0-9_]?[A-Z0-9]+)*"};
  const std::regex field_rule{"[a-z]([a-z0-9]|_(?!_))*[a-z0-9]|[a-z]"};
  std::set<std::string> names;
  for (const GroupMessage& message : group_messages()) {
    EXPECT_TRUE(std::regex_match(message.name, message_rule)) << message.name;
    EXPECT_TRUE(names.insert(message.name).second) << message.name;
    std::set<std::string> inside;
    for (const ros::FieldDescription& field : message.type.type.fields) {
      EXPECT_TRUE(std::regex_match(field.name, field_rule)) << field.name;
      EXPECT_TRUE(inside.insert(field.name).second) << field.name;
    }
    for (const ros::Constant& constant : message.type.type.constants) {
      const std::string name{constant.name};
      EXPECT_TRUE(std::regex_match(name, constant_rule)) << name;
      EXPECT_TRUE(inside.insert(name).second) << name;
    }
  }
}

// rosidl makes members of C, C++ and Python of them.
TEST(GroupMessage, NoFieldIsAWordOfALanguageThatIsMadeOfIt) {
  const std::set<std::string> words{
      "and",    "as",     "auto",  "bool",   "break", "case",  "class", "const", "def",
      "delete", "do",     "else",  "enum",   "for",   "from",  "goto",  "if",    "import",
      "in",     "int",    "is",    "lambda", "new",   "not",   "or",    "pass",  "short",
      "signed", "switch", "this",  "try",    "union", "using", "void",  "while", "with",
      "yield",  "double", "float", "long",   "char",  "none"};
  for (const GroupMessage& message : group_messages())
    for (const ros::FieldDescription& field : message.type.type.fields)
      EXPECT_FALSE(words.contains(field.name)) << message.group << "." << field.name;
}

TEST(GroupMessage, EveryFieldOfTheCarAndOfTheBaseIsInOne) {
  std::size_t of_car = 0, of_base = 0;
  for (const GroupMessage& message : group_messages()) {
    ASSERT_EQ(message.type.type.fields.size(), message.rows.size() + 1);
    for (std::size_t i = 0; i < message.rows.size(); ++i) {
      const std::string_view wanted = message.of_base ? state::kBaseTable[message.rows[i]].name
                                                      : telemetry::kFields[message.rows[i]].name;
      EXPECT_EQ(message.type.type.fields[i + 1].name, wanted);
    }
    (message.of_base ? of_base : of_car) += message.rows.size();
  }
  std::size_t down = 0;
  for (const telemetry::FieldRow& row : telemetry::kFields)
    down += telemetry::row_of(row.group).direction == telemetry::Direction::kDown ? 1U : 0U;
  EXPECT_EQ(of_car, down);
  EXPECT_EQ(of_base, state::kBaseFields);
  EXPECT_EQ(group_messages()[message_index(Group::kTyres)].name, "Tyres");
}

TEST(GroupMessage, TheTextHasUnitsAndTheNamesOfChoices) {
  const std::string flags =
      ros::file_text(group_messages()[message_index(Group::kFlags)].type.type);
  EXPECT_NE(flags.find("float64 TRACK_RED=1.0\n"), flags.npos) << flags;
  EXPECT_NE(flags.find("float64 round_target_speed  # m/s, 0 to 102; NaN: not known\n"),
            flags.npos);
  EXPECT_NE(flags.find("float64 conflict  # 0 no, 1 yes; NaN: not known\n"), flags.npos);
  const std::string excluded =
      ros::file_text(group_messages()[message_index(Group::kLocalization)].type.type);
  EXPECT_NE(excluded.find("uint32 EXCLUDED_BIT_IMU0=4\n"), excluded.npos) << excluded;
}

// Foxglove's reader finds in our bytes what was put in, NaN included, by the text alone.
TEST(GroupMessage, FoxglovesReaderDecodesEachOfThem) {
  NEEDS_ORACLES();
  pitwall::testing::RosOracle oracle;
  for (const GroupMessage& message : group_messages()) {
    ros::Header header{.stamp = {.sec = 12, .nanosec = 345}, .frame_id = "map"};
    std::vector<double> values;
    std::string output = R"({"header":{"stamp":{"sec":12,"nanosec":345},"frame_id":"map"})";
    for (std::size_t i = 0; i < message.rows.size(); ++i) {
      values.push_back(i % 3 == 1 ? kUnset : static_cast<double>(i) + 0.5);
      output += ",\"" + message.type.type.fields[i + 1].name +
                "\":" + (i % 3 == 1 ? "\"NaN\"" : std::to_string(i) + ".5");
    }
    std::vector<std::uint8_t> bytes;
    encode_group(header, values, bytes);
    oracle.add(message.type.type.name, ros::message_text(message.type), bytes, output + "}");
  }
  oracle.expect_agreement();
}

}  // namespace
}  // namespace pitwall::publishers::ros_view

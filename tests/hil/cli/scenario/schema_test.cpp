// The JSON schemas for editors say what the readers say: with Debian's python3-jsonschema as judge
// of the schemas, and the readers of the bench beside it.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "hil/bench/signals.hpp"
#include "hil/faults/bench_fault.hpp"
#include "hil/faults/frame_fault.hpp"
#include "hil/scenario/scenario.hpp"
#include "hil/sweep/plan.hpp"
#include "protocol/json/json_value.hpp"
#include "protocol/transport/file.hpp"
#include "tests/hil/cli/program_run.hpp"

namespace pitwall::cli {
namespace {

const std::string kRoot = PITWALL_SOURCE_DIR;
const std::string kHere = kRoot + "/tests/hil/cli/scenario/";
const std::string kSchemas = kRoot + "/hil/config/schemas/";

// What a reader says of a document; empty: it takes it.
using Reader = std::function<std::string(const std::string& text)>;

std::string read_scenario_file(const std::string& text) {
  const auto scenario = scenario::read_scenario(text, "case.yaml");
  if (!scenario) return to_string(scenario.error());
  for (const scenario::Fault& fault : scenario->faults)
    if (!faults::bench_fault_kind(fault.kind) && !faults::frame_fault_kind(fault.kind))
      return "unknown fault " + fault.kind;
  const auto expectations = bench::expectations_of(*scenario);
  return expectations ? "" : to_string(expectations.error());
}

std::string read_plan_file(const std::string& text) {
  const auto plan = sweep::read_plan(text, "case.yaml");
  return plan ? "" : to_string(plan.error());
}

// What a schema cannot say, since it sets one value against another: what the reader then says.
const std::vector<std::string> kAcrossScenario{
    "the run ends before this window begins",
    "the window ends before it begins",
    "expected the number of an entry of faults",
    "has an entry after match.begins_s",
    "no other car has the name",
    "another car has this",
    "is above the car's limit brake_mps2",
    "must be longer than for_s",
    "expected right of inside_m",
    "most_m: 0.001 is outside [0.2",
    "most_mps: 0.001 is outside [0.4",
    "is not later than the one before",
    "the round speeds must rise",
    "the stations must rise",
    "until_s: 20 is outside [36000",
    "until_s: 0 is outside [5",
};
const std::vector<std::string> kAcrossPlan{"the range is empty", "parameters: 3000000 cases",
                                           "is there twice"};

// The words that a message lists after "is not one of", in either wording; empty: it does not.
std::set<std::string> words_listed(const std::string& message) {
  const std::size_t at = message.find("is not one of");
  if (at == std::string::npos) return {};
  static const std::regex kWord{"\\w+|[<>=!]+"};
  const std::string list = message.substr(at + std::string{"is not one of"}.size());
  return {std::sregex_token_iterator{list.begin(), list.end(), kWord}, {}};
}

class Schema : public ProgramRun {
 protected:
  std::vector<json::JsonValue> cases(std::vector<std::string> words) {
    words.insert(words.begin(), kHere + "schema_cases.py");
    const ProgramOutput made = run(words, "/usr/bin/python3");
    EXPECT_EQ(made.code, 0) << made.err;
    const auto read = json::JsonValue::parse(made.out, "cases");
    if (!read) ADD_FAILURE() << to_string(read.error());
    return read ? read->items() : std::vector<json::JsonValue>{};
  }

  // Each case is taken by both or refused by both, but for the reasons of `across`.
  void expect_agreement(const std::vector<std::string>& words, const Reader& read,
                        const std::vector<std::string>& across) {
    std::size_t taken = 0, refused = 0;
    std::set<std::string> met;
    for (const json::JsonValue& one : cases(words)) {
      const std::string reason = read(one.text("text"));
      const bool is_valid = one.flag("valid");
      (is_valid ? taken : refused) += 1;
      const std::set<std::string> own_words = words_listed(reason),
                                  schema_words = words_listed(one.text("why"));
      if (!own_words.empty() && !schema_words.empty()) {
        EXPECT_EQ(own_words, schema_words) << one.text("change");
      }
      const auto known = std::ranges::find_if(across, [&reason](const std::string& part) {
        return reason.find(part) != std::string::npos;
      });
      if (is_valid && known != across.end()) {
        met.insert(*known);
        continue;
      }
      EXPECT_EQ(is_valid, reason.empty())
          << one.text("change") << "\n  the schema: " << one.text("why")
          << "\n  the reader: " << reason;
    }
    EXPECT_GT(taken, 10U);
    EXPECT_GT(refused, 10U);
    EXPECT_EQ(met, std::set<std::string>(across.begin(), across.end()));
  }
};

TEST_F(Schema, OfAScenarioAgreesWithItsReaderAroundEveryLimit) {
  expect_agreement({kSchemas + "scenario.schema.json", kHere + "every_key.yaml"},
                   read_scenario_file, kAcrossScenario);
}

TEST_F(Schema, OfAPlanAgreesWithItsReaderAroundEveryLimit) {
  expect_agreement({kSchemas + "sweep.schema.json", kHere + "plan_draw.yaml",
                    kHere + "plan_all.yaml", kHere + "plan_pairs.yaml"},
                   read_plan_file, kAcrossPlan);
}

std::vector<std::string> files_in(const std::string& folder) {
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    if (entry.path().extension() == ".yaml") files.push_back(entry.path().string());
  return files;
}

TEST_F(Schema, TakesWhatIsShipped) {
  std::vector<std::string> words{"--as-is", kSchemas + "scenario.schema.json"};
  const std::vector<std::string> scenarios = files_in(kRoot + "/hil/scenarios");
  words.insert(words.end(), scenarios.begin(), scenarios.end());
  EXPECT_EQ(cases(words).size(), scenarios.size());
  words = {"--as-is", kSchemas + "sweep.schema.json"};
  for (const std::string& file : files_in(kRoot + "/hil/config/sweeps")) {
    const std::string text = transport::read_file(file).value_or("");
    if (text.find("\ncombine:") != std::string::npos) words.push_back(file);  // no car file
  }
  EXPECT_EQ(cases(words).size(), 2U);
}

std::set<std::string> words_of(const json::JsonValue& schema, const char* name) {
  std::set<std::string> words;
  const json::JsonValue* definition = schema.find("$defs")->find(name);
  if (const json::JsonValue* properties = definition->find("properties"))
    definition = properties->find("kind");
  for (const json::JsonValue& word : definition->items("enum")) words.insert(word.text());
  return words;
}

TEST_F(Schema, ListsEverySignalAndEveryFault) {
  const std::string text = transport::read_file(kSchemas + "scenario.schema.json").value_or("");
  const auto schema = json::JsonValue::parse(text, "schema");
  ASSERT_TRUE(schema);
  const std::vector<std::string> signals = bench::signal_names();
  EXPECT_EQ(words_of(*schema, "signal"), std::set<std::string>(signals.begin(), signals.end()));
  std::set<std::string> faults;
  for (std::size_t i = 0; i < faults::kBenchFaultKinds; ++i)
    faults.emplace(faults::row_of(static_cast<faults::BenchFaultKind>(i)).name);
  for (std::size_t i = 0; i < faults::kFrameFaultKinds; ++i)
    faults.emplace(faults::name_of(static_cast<faults::FrameFaultKind>(i)));
  EXPECT_EQ(words_of(*schema, "fault"), faults);
}

// The keys that the text of a reader asks a mapping for.
std::set<std::string> keys_asked_for(const std::string& source) {
  static const std::regex kAsked{
      "(?:number|integer|text|numbers|texts|map|maps|optional_map|has)(?:_or)?\\(\"(\\w+)\""};
  const std::string text = transport::read_file(kRoot + "/" + source).value_or("");
  std::set<std::string> keys;
  for (std::sregex_iterator at{text.begin(), text.end(), kAsked}, end; at != end; ++at)
    keys.insert((*at)[1]);
  EXPECT_FALSE(keys.empty()) << source;
  return keys;
}

TEST_F(Schema, HasEveryKeyThatItsReaderAsksFor) {
  const auto expect_in = [](const char* schema, const char* source) {
    const std::string text = transport::read_file(kSchemas + schema).value_or("");
    for (const std::string& key : keys_asked_for(source))
      EXPECT_NE(text.find("\"" + key + "\": {"), std::string::npos) << key << " of " << source;
  };
  for (const char* source : {"hil/scenario/scenario.cpp", "hil/scenario/cars_section.cpp",
                             "hil/scenario/match_section.cpp", "hil/scenario/radio_section.cpp",
                             "hil/scenario/expect_section.cpp"})
    expect_in("scenario.schema.json", source);
  expect_in("sweep.schema.json", "hil/sweep/plan.cpp");
}

}  // namespace
}  // namespace pitwall::cli

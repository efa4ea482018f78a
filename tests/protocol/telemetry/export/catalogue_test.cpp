// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/export/catalogue.hpp"

#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <string>

#include "protocol/telemetry/registry/schema.hpp"
#include "protocol/telemetry/registry/titles.hpp"

namespace pitwall::telemetry {
namespace {

std::string text(const YAML::Node& node) { return node.as<std::string>(); }
double number(const YAML::Node& node) { return node.as<double>(); }

template <class Row>
void expect_row(const YAML::Node& json, const Row& row) {
  EXPECT_EQ(text(json["name"]), row.name);
  EXPECT_EQ(text(json["unit"]), row.unit);
  EXPECT_EQ(number(json["min"]), row.min);
  EXPECT_EQ(number(json["max"]), row.max);
  EXPECT_EQ(number(json["resolution"]), row.resolution);
  EXPECT_EQ(json["bits"].as<unsigned>(), row.quantized().bits());
  EXPECT_EQ(json["labels"].IsDefined(), !row.labels.empty());
  if (!json["labels"].IsDefined()) return;
  for (std::size_t i = 0; i < json["labels"].size(); ++i)
    EXPECT_EQ(text(json["labels"][i]), label_at(row.labels, i));
}

TEST(Catalogue, SaysOfEveryRowWhatTheRegistrySays) {
  const YAML::Node json = YAML::Load(catalogue_json());
  EXPECT_EQ(std::stoull(text(json["schema"]), nullptr, 16), kSchemaHash);
  EXPECT_EQ(std::stoull(text(json["safety"]), nullptr, 16), kSafetyHash);
  ASSERT_EQ(json["groups"].size(), kGroups);
  for (const GroupRow& row : kGroupTable) {
    const YAML::Node group = json["groups"][index_of(row.group)];
    EXPECT_EQ(text(group["name"]), row.name);
    EXPECT_EQ(text(group["direction"]), text_of(row.direction));
    EXPECT_EQ(text(group["class"]), text_of(row.priority));
    EXPECT_EQ(number(group["target_age_ms"]), row.target_age.milliseconds());
    EXPECT_EQ(number(group["weight"]), row.weight);
    EXPECT_EQ(number(group["bits"]), static_cast<double>(group_bits(row.group)));
    EXPECT_EQ(std::stoull(text(group["hash"]), nullptr, 16), group_hash(row.group));
    const auto [first, count] = fields_of(row.group);
    ASSERT_EQ(group["fields"].size(), count);
    for (std::size_t i = 0; i < count; ++i) {
      expect_row(group["fields"][i], kFields[first + i]);
      EXPECT_EQ(text(group["fields"][i]["path"]),
                std::string{row.name} + "." + std::string{kFields[first + i].name});
      EXPECT_EQ(text(group["fields"][i]["title"]), title_of(row.name, kFields[first + i].name));
    }
  }
  ASSERT_EQ(json["commands"].size(), kCommandTypes);
  for (std::size_t i = 0; i < kCommandTypes; ++i) {
    expect_row(json["commands"][i], kCommandTable[i]);
    EXPECT_EQ(json["commands"][i]["needs_authority"].as<bool>(), kCommandTable[i].needs_authority);
  }
}

}  // namespace
}  // namespace pitwall::telemetry

// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/export/golden_vectors.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <map>
#include <sstream>
#include <string>

#include "protocol/telemetry/registry/schema_listing.hpp"

namespace pitwall::telemetry {
namespace {

const std::string kFile = PITWALL_SOURCE_DIR "/tests/golden/telemetry/groups.txt";

// An intended change of the air shows as a change of this file (PITWALL_WRITE_GOLDEN=1 writes it).
TEST(GoldenVectors, AreThoseOfTheFile) {
  if (std::getenv("PITWALL_WRITE_GOLDEN") != nullptr) std::ofstream{kFile} << golden_vectors();
  std::ifstream in{kFile};
  const std::string golden{std::istreambuf_iterator<char>{in}, {}};
  EXPECT_EQ(golden_vectors(), golden);
}

// ---- What somebody else would make of the file and the text of the registry: strings only.

std::string binary(std::uint64_t value, std::size_t digits) {
  std::string text;
  for (; digits > 0; --digits, value /= 2) text.insert(text.begin(), value % 2 != 0 ? '1' : '0');
  return text;
}

std::size_t digits_of(const ListedField& field) {
  const double steps = (std::stod(field.max) - std::stod(field.min)) / std::stod(field.resolution);
  const auto codes = static_cast<std::uint64_t>(steps + 0.5) + 2;  // both ends, and unset
  std::size_t digits = 0;
  while ((std::uint64_t{1} << digits) < codes) ++digits;
  return digits;
}

std::string hex_of_binary(std::string bits) {
  bits.resize((bits.size() + 7) / 8 * 8, '0');
  std::string text;
  for (std::size_t i = 0; i < bits.size(); i += 4)
    text += "0123456789abcdef"[std::stoul(bits.substr(i, 4), nullptr, 2)];
  return text;
}

TEST(GoldenVectors, AreWhatTheTextOfTheRegistrySaysToAStranger) {
  std::map<std::string, ListedGroup> groups;
  for (const ListedGroup& group : read_listing(schema_text()).groups) groups[group.name] = group;
  std::ifstream file{kFile};
  std::size_t vectors = 0;
  for (std::string line; std::getline(file, line); ++vectors) {
    std::istringstream in{line};
    std::string group, name, word, bits;
    in >> group >> name;
    ASSERT_TRUE(groups.contains(group)) << group;
    for (const ListedField& field : groups[group].fields) {
      in >> word;
      ASSERT_TRUE(word.starts_with(field.name + "=")) << line;
      const std::string code = word.substr(field.name.size() + 1);
      const std::size_t digits = digits_of(field);
      bits += code == "-" ? std::string(digits, '1') : binary(std::stoull(code), digits);
    }
    in >> word;
    EXPECT_EQ(word, hex_of_binary(bits)) << line;
  }
  EXPECT_EQ(vectors, 4 * kGroups);
}

}  // namespace
}  // namespace pitwall::telemetry

// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/export/lcm_schema.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>

namespace pitwall::telemetry {
namespace {

// Of the type that lcm-gen has made of our text.
std::uint64_t fingerprint_by_lcm(const std::filesystem::path& folder, const std::string& type) {
  std::ostringstream text;
  text << std::ifstream{folder / "pitwall" / (type + ".py")}.rdbuf();
  static const std::regex kHash{R"(tmphash = \(0x([0-9a-f]+)\))"};
  std::smatch found;
  const std::string all = text.str();
  if (!std::regex_search(all, found, kHash)) return 0;
  return std::rotl(std::stoull(found[1], nullptr, 16), 1);
}

TEST(LcmSchema, LcmGenTakesThemAndHasTheSameFingerprints) {
  ASSERT_EQ(std::system("command -v lcm-gen >/dev/null"), 0)
      << "lcm-gen is not installed (./pitwall setup)";
  const std::filesystem::path folder = ::testing::TempDir() + "pitwall_lcm_types";
  std::filesystem::create_directories(folder);
  std::ofstream{folder / "pitwall.lcm"} << lcm_types_text();
  const std::string call = "lcm-gen --python --ppath " + folder.string() + " " +
                           (folder / "pitwall.lcm").string() + " >/dev/null";
  ASSERT_EQ(std::system(call.c_str()), 0);
  std::vector<LcmType> types{lcm_text_type(), lcm_datagram_type(), lcm_bytes_type(),
                             lcm_can_type()};
  for (const GroupRow& row : kGroupTable) types.push_back(lcm_type(row.group));
  for (const LcmType& type : types) {
    EXPECT_EQ(fingerprint_by_lcm(folder, type.name), lcm_fingerprint(type)) << type.name;
  }
  std::filesystem::remove_all(folder);
}

TEST(LcmSchema, EveryGroupHasATypeWithItsFields) {
  for (const GroupRow& row : kGroupTable) {
    const LcmType type = lcm_type(row.group);
    EXPECT_EQ(type.name, std::string{row.name} + "_t");
    ASSERT_EQ(type.members.size(), fields_of(row.group).count + 1);
    EXPECT_EQ(type.members.front().name, "utime");
    EXPECT_EQ(type.members.back().name,
              kFields[fields_of(row.group).first + fields_of(row.group).count - 1].name);
  }
}

}  // namespace
}  // namespace pitwall::telemetry

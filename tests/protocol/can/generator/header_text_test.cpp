// SPDX-License-Identifier: Apache-2.0
#include "protocol/can/generator/header_text.hpp"

#include <gtest/gtest.h>

#include "tests/protocol/can/dbc_files.hpp"

namespace pitwall::can {
namespace {

const std::string kManifest =
    "database: t.dbc\nrevision: r\nmessages:\n  M:\n    direction: to_car\n    safety: status\n"
    "    period_ms: 10\n    timeout_ms: 50\n";

std::string refusal(const std::string& dbc, const std::string& manifest = kManifest) {
  const Database d = parsed(dbc);
  const auto m = parse_manifest(manifest, "t.yaml");
  if (!m) return to_string(m.error());
  const auto text = header_text(d, *m, "t");
  return text ? "" : to_string(text.error());
}

TEST(HeaderText, NamesOfStructs) {
  EXPECT_EQ(struct_name("base_to_car_summary"), "BaseToCarSummary");
  EXPECT_EQ(struct_name("pt_report_1"), "PtReport1");
  EXPECT_EQ(struct_name("Tire_Temp_FL_1"), "TireTempFl1");
  EXPECT_EQ(struct_name("Tire_Pressure_FL"), "TirePressureFl");
  EXPECT_EQ(struct_name("ct_report_2"), "CtReport2");
}

TEST(HeaderText, RefusesWhatItCannotSay) {
  const std::string end = " (1,0) [0|0] \"\" A\n";
  EXPECT_EQ(refusal(dbc_with(" SG_ a : 0|8@1+" + end)), "");
  EXPECT_EQ(refusal(dbc_with(" SG_ class : 0|8@1+" + end)),
            "t.dbc:8:6: error: class cannot be a name in C++");
  EXPECT_NE(refusal(dbc_with(" SG_ 9a : 0|8@1+" + end)), "");
  EXPECT_NE(refusal(dbc_with(" SG_ s M : 0|8@1+" + end + " SG_ a m1 : 8|8@1+" + end)), "");
  EXPECT_EQ(refusal(dbc_with(" SG_ a : 0|8@1+" + end, 12)), "");
  EXPECT_NE(refusal(dbc_with(" SG_ a : 0|8@1+ (1,0) [5|2] \"\" A\n")), "");
  EXPECT_NE(refusal(dbc_with(" SG_ a : 0|8@1+" + end) + "BO_ 101 N: 8 A\n"), "");
  std::string two = kManifest + kManifest.substr(kManifest.find("  M:"));
  two.replace(two.rfind("  M:"), 4, "  m:");
  EXPECT_EQ(refusal(dbc_with(" SG_ a : 0|8@1+" + end) + "BO_ 101 m: 8 A\n", two),
            "t.dbc:10:1: error: two messages would become M");
}

TEST(HeaderText, IsTheSameForTheSameInput) {
  const Database d = load(kOwnDbc);
  const auto m = parse_manifest(text_of(kOwnManifest), "av21.manifest.yaml");
  ASSERT_TRUE(m);
  const auto a = header_text(d, *m, "av21"), b = header_text(d, *m, "av21");
  ASSERT_TRUE(a);
  EXPECT_EQ(*a, *b);
  for (const Message& message : d.messages) {
    EXPECT_NE(a->find("struct " + struct_name(message.name) + " {"), std::string::npos);
  }
}

}  // namespace
}  // namespace pitwall::can

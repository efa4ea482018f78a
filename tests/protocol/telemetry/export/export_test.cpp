// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/export/export.hpp"

#include <gtest/gtest.h>

#include "protocol/telemetry/registry/schema_listing.hpp"

namespace pitwall::telemetry {
namespace {

TEST(Export, EveryKindHasATextOfItsOwn) {
  for (const std::string_view kind : kExportKinds) {
    const auto text = export_text(kind);
    ASSERT_TRUE(text.has_value()) << kind;
    EXPECT_GT(text->size(), 1'000U) << kind;
    EXPECT_EQ(text->back(), '\n') << kind;
  }
  EXPECT_EQ(export_text("schema"), schema_text());
}

TEST(Export, OfAKindThatThereIsNotIsNothing) {
  EXPECT_FALSE(export_text("").has_value());
  EXPECT_FALSE(export_text("JSON").has_value());
}

}  // namespace
}  // namespace pitwall::telemetry

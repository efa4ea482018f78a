// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/export/export.hpp"

#include "protocol/telemetry/export/catalogue.hpp"
#include "protocol/telemetry/export/dissector.hpp"
#include "protocol/telemetry/export/golden_vectors.hpp"
#include "protocol/telemetry/export/handbook.hpp"
#include "protocol/telemetry/export/lcm_schema.hpp"
#include "protocol/telemetry/registry/schema_listing.hpp"

namespace pitwall::telemetry {

std::optional<std::string> export_text(std::string_view kind) {
  if (kind == "schema") return schema_text();
  if (kind == "golden") return golden_vectors();
  if (kind == "json") return catalogue_json();
  if (kind == "markdown") return handbook_markdown();
  if (kind == "lua") return dissector_lua();
  if (kind == "lcm") return lcm_types_text();
  return std::nullopt;
}

}  // namespace pitwall::telemetry

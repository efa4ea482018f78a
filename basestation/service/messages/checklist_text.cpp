// SPDX-License-Identifier: Apache-2.0
#include "basestation/service/messages/checklist_text.hpp"

#include "protocol/json/json_text.hpp"

namespace pitwall::service {

std::string checklist_text(const std::vector<command::Check>& checks, Instant now) {
  json::Array list;
  for (const command::Check& check : checks) {
    list.json(json::Object{}
                  .text("name", command::text_of(check.kind))
                  .flag("go", check.go)
                  .flag("known", check.known)
                  .number("age_ms", check.age.milliseconds())
                  .text("text", check.text)
                  .str());
  }
  return json::Object{}
      .text("type", "checklist")
      .number("time_ms", now.milliseconds())
      .flag("go", command::all_go(checks))
      .json("checks", list.str())
      .str();
}

}  // namespace pitwall::service

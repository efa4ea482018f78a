// SPDX-License-Identifier: Apache-2.0
#include "basestation/session/roster.hpp"

#include "protocol/json/json_text.hpp"

namespace pitwall::session {

std::string roster_text(const std::vector<CarStatus>& cars) {
  json::Array list;
  for (const CarStatus& car : cars) {
    json::Object row;
    row.number("number", car.number).text("name", car.name).text("mode", car.mode);
    list.json((car.link.empty() ? row.json("link", "null") : row.text("link", car.link)).str());
  }
  return json::Object{}.json("cars", list.str()).str();
}

void Roster::serve(Instant now) {
  if (now < due_) return;
  due_ = now + kEvery;
  std::string text = roster_text(read_status_());
  if (text == reported_) return;
  reported_ = text;
  server_.show(kRosterPath, {std::move(text), publishers::web::kJsonType});
}

}  // namespace pitwall::session

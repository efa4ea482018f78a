// SPDX-License-Identifier: Apache-2.0
#include "hil/cli/bench_server/bench_request.hpp"

#include <cmath>

#include "protocol/json/json_value.hpp"

namespace pitwall::bench_server {
namespace {

Result<BenchRequest, Problem> start_request(const json::JsonValue& value, std::string by) {
  StartRunRequest request{.scenario = value.text("scenario"), .seed = {}, .by = std::move(by)};
  if (request.scenario.empty() || request.scenario.size() > kNameMax)
    return refuse("scenario", "expected a text of 1 to " + std::to_string(kNameMax) + " bytes");
  const std::string mode = value.text("mode");
  if (mode != "lockstep" && mode != "live")
    return refuse("mode", "expected one of: lockstep, live");
  request.live = mode == "live";
  const json::JsonValue* const seed = value.find("seed");
  if (seed == nullptr || seed->is_null()) return BenchRequest{request};
  const double number = seed->number();
  if (!(number >= 0.0 && number <= static_cast<double>(kSeedMax)) || number != std::floor(number))
    return refuse("seed", "expected a whole number from 0 to " + std::to_string(kSeedMax));
  request.seed = static_cast<std::uint64_t>(number);
  return BenchRequest{request};
}

Result<BenchRequest, Problem> page_request(const json::JsonValue& value) {
  const double from = value.number("from");
  if (!(from >= 0.0 && from <= static_cast<double>(kMaxPageBytes)) || from != std::floor(from))
    return refuse("from", "expected a whole number from 0 to " + std::to_string(kMaxPageBytes));
  return BenchRequest{
      PageRequest{.page = value.text("page"), .from = static_cast<std::size_t>(from)}};
}

}  // namespace

Result<BenchRequest, Problem> parse_request(std::string_view line) {
  const auto value = json::JsonValue::parse(line, "line");
  if (!value) return Unexpected{value.error()};
  std::string by = value->text("by");
  if (by.size() > kNameMax)
    return refuse("by", "expected at most " + std::to_string(kNameMax) + " bytes");
  const std::string action = value->text("do");
  if (action == "start") return start_request(*value, std::move(by));
  if (action == "stop") return BenchRequest{StopRunRequest{std::move(by)}};
  if (action == "page") return page_request(*value);
  return refuse("do", "expected one of: start, stop, page");
}

}  // namespace pitwall::bench_server

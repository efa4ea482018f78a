// SPDX-License-Identifier: Apache-2.0
#include "basestation/publishers/bench/bench_state.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "protocol/json/json_text.hpp"

namespace pitwall::publishers::bench {
namespace {

using json::JsonValue;

constexpr double kProtocol = 1.0;

// The members that a console relies on.
struct Shape {
  std::string_view type;
  std::vector<std::string_view> numbers, texts, lists;
};
const std::array<Shape, 10>& shapes() {
  static const std::array<Shape, 10> kShapes{
      {{"hello", {"protocol", "scenarios", "unreadable"}, {"server"}, {}},
       {"scenario", {}, {"id", "name"}, {"faults", "expect"}},
       {"run", {"run", "seed"}, {"state", "scenario", "name", "mode"}, {}},
       {"plan", {"run", "duration_s"}, {"mode"}, {"faults", "flags", "operator", "expect"}},
       {"event", {"run", "t_s"}, {"kind"}, {}},
       {"at", {"run", "t_s"}, {}, {"cross_track", "expect", "reactions"}},
       {"result", {"run"}, {}, {"reactions"}},
       {"sweeps", {}, {}, {"sweeps"}},
       {"page", {"from"}, {"page"}, {}},
       {"error", {}, {"place", "what"}, {}}}};
  return kShapes;
}

Result<bool, Problem> fits(const JsonValue& value) {
  const std::string type = value.text("type");
  const auto shape = std::ranges::find(shapes(), std::string_view{type}, &Shape::type);
  if (shape == shapes().end()) return refuse("type", "unknown type of line");
  for (const std::string_view member : shape->numbers)
    if (!std::isfinite(value.number(member))) return refuse(member, "expected a number");
  for (const std::string_view member : shape->texts)
    if (value.text(member).empty()) return refuse(member, "expected a text");
  for (const std::string_view member : shape->lists) {
    const JsonValue* const found = value.find(member);
    if (found == nullptr || !found->is_list()) return refuse(member, "expected a list");
  }
  return true;
}

}  // namespace

void BenchState::connected() {
  complete_ = false;
  list_.clear();
  scenarios_ = announced_ = 0;
  events_again_ = 0;
}

Result<bool, Problem> BenchState::take(std::string_view line) {
  const auto value = JsonValue::parse(line, "line");
  auto kept = value ? keep(*value, line) : Result<bool, Problem>{Unexpected{value.error()}};
  ++(kept ? counters_.taken : counters_.refused);
  return kept;
}

Result<bool, Problem> BenchState::keep(const JsonValue& value, std::string_view line) {
  if (auto fit = fits(value); !fit) return fit;
  const std::string type = value.text("type");
  if (type == "hello") return keep_hello(value);
  if (type == "error") {
    refusal_ = Problem{"bench." + value.text("place"), value.text("what")};
    return true;
  }
  if (type == "page") {
    page_part_ = value;
    return true;
  }
  if (server_.empty()) return refuse("type", "expected hello first");
  if (type == "scenario") return keep_scenario(line);
  if (type == "sweeps") return keep_sweeps(line);
  if (type == "run") return keep_run(value, line);
  if (value.number("run") != run_) return refuse("run", "expected the number of the newest run");
  if (type == "event") return keep_event(value, line);
  publish("bench_" + type, line);
  return true;
}

Result<bool, Problem> BenchState::keep_hello(const JsonValue& value) {
  if (value.number("protocol") != kProtocol) return refuse("protocol", "expected version 1");
  if (!value.flag("simulation")) return refuse("simulation", "expected true");
  const double count = value.number("scenarios");
  if (!(count >= 0.0 && count <= static_cast<double>(kMaxScenarios)) || count != std::floor(count))
    return refuse("scenarios", "expected a whole number up to " + std::to_string(kMaxScenarios));
  if (value.text("server") != server_) {
    server_ = value.text("server");
    run_ = 0.0;
    events_ = 0;
  }
  connected();
  announced_ = static_cast<std::size_t>(count);
  if (announced_ == 0) publish("bench_list", "[]");
  complete_ = announced_ == 0;
  return true;
}

Result<bool, Problem> BenchState::keep_scenario(std::string_view line) {
  if (scenarios_ >= announced_) return refuse("scenario", "more scenarios than hello announced");
  if (list_.size() + line.size() > kListMax_bytes)
    return refuse("scenario", "the list is too long");
  if (!list_.empty()) list_ += ", ";
  list_ += line;
  complete_ = ++scenarios_ == announced_;
  if (complete_) publish("bench_list", "[" + std::exchange(list_, {}) + "]");
  return true;
}

Result<bool, Problem> BenchState::keep_sweeps(std::string_view line) {
  publish("bench_sweeps", line);
  return true;
}

Result<bool, Problem> BenchState::keep_run(const JsonValue& value, std::string_view line) {
  if (value.number("run") != run_) {
    run_ = value.number("run");
    events_ = events_again_ = 0;
    // Nothing of the run before is shown with this one.
    for (const char* const type : {"bench_plan", "bench_at", "bench_result"}) publish(type, "null");
  }
  publish("bench_run", line);
  return true;
}

Result<bool, Problem> BenchState::keep_event(const JsonValue& value, std::string_view line) {
  if (value.find("text") == nullptr) return refuse("text", "expected a text");
  if (events_again_ < events_) {
    ++events_again_;
    return true;
  }
  if (events_ >= kEventsMax)
    return refuse("event", "more than " + std::to_string(kEventsMax) + " events in one run");
  events_again_ = ++events_;
  publish("bench_event", line, true);
  return true;
}

void BenchState::publish(const std::string& type, std::string_view of, bool line) {
  std::string text = json::Object{}.text("type", type).text("server", server_).json("of", of).str();
  if (!line) std::erase_if(news_, [&](const Reported& older) { return older.type == type; });
  news_.push_back({.type = type, .text = std::move(text), .line = line});
}

std::vector<Reported> BenchState::news() { return std::exchange(news_, {}); }

}  // namespace pitwall::publishers::bench

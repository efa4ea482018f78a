// SPDX-License-Identifier: Apache-2.0
#include "basestation/session/plan.hpp"

#include <memory>
#include <utility>

#include "basestation/link/key_log_file.hpp"
#include "basestation/link/key_pair.hpp"
#include "basestation/link/stamp_file.hpp"
#include "basestation/publishers/console/catalogue_text.hpp"
#include "basestation/publishers/console/recording_list.hpp"
#include "basestation/publishers/console/track_document.hpp"
#include "basestation/publishers/web/tls_files.hpp"
#include "basestation/service/limits_store.hpp"
#include "basestation/session/roster.hpp"
#include "basestation/settings/data_files.hpp"
#include "protocol/transport/clock.hpp"
#include "protocol/transport/file.hpp"

namespace pitwall::session {
namespace {

namespace console = publishers::console;
namespace web = publishers::web;
using settings::Arguments;

constexpr std::uint16_t kDefaultPort = 23'431;
constexpr std::uint32_t kLoopbackNet = 127U << 24U, kNetMask = 0xFF00'0000U;
constexpr double kBytesPerKbit = 125.0;

Result<std::vector<UdpAddress>, Problem> addresses_of(const Arguments& arguments) {
  std::vector<std::string> wanted = arguments.listen;
  if (wanted.empty()) wanted.push_back(to_string(UdpAddress{.port = kDefaultPort}));
  if (wanted.size() > telemetry::kPaths) {
    return Unexpected{Problem{"--listen", "expected at most two radios"}};
  }
  std::vector<UdpAddress> addresses;
  for (const std::string& text : wanted) {
    const auto address = transport::parse_udp_address(text);
    if (!address) return Unexpected{Problem{"--listen", to_string(address.error())}};
    if ((address->ip & kNetMask) != kLoopbackNet && !arguments.network) {
      return Unexpected{
          Problem{"--listen " + text, "reaches other machines; add --network if that is meant"}};
    }
    addresses.push_back(*address);
  }
  return addresses;
}

bool is_loopback(const std::string& address) { return address.starts_with("127."); }

Result<bool, Problem> plan_access(const Arguments& a, web::AccessRules& access) {
  access.names = a.web_names;
  access.default_role.reset();
  const bool local = is_loopback(a.web_address);
  if (!local && !a.default_role.empty()) {
    return Unexpected{
        Problem{"--default-role " + a.default_role,
                "allowed on loopback only; --web-tokens FILE says who may come in from elsewhere"}};
  }
  if (!local && a.tokens_file.empty()) {
    return Unexpected{Problem{"--web-address " + a.web_address,
                              "reaches other machines; --web-tokens FILE says who may come in"}};
  }
  if (a.default_role == "viewer") access.default_role = web::Role::kViewer;
  if (a.default_role == "operator" || (a.default_role.empty() && a.tokens_file.empty()))
    access.default_role = web::Role::kOperator;
  return use_tokens(a.tokens_file, access);
}

// Limits, alarms and course, by which the car is judged with consoles and without.
Result<bool, Problem> plan_service(const Arguments& a, Plan& plan, const LogLine& log) {
  if (!a.judgement_file.empty()) {
    auto store = std::make_shared<service::LimitsStore>(a.judgement_file);
    if (!store->remark().empty()) log(store->remark());
    service::use_limits(plan.service, std::move(store), a.budget_kbit);
  }
  plan.http.documents["/api/track"] = {};
  if (!a.track.empty()) {
    auto track = console::read_track(settings::track_file(a.track));
    if (!track) return Unexpected{track.error()};
    plan.http.documents["/api/track"] = std::move(track->json);
    plan.service.evaluator.course = std::move(track->course);
  }
  plan.service.car = a.car;
  plan.service.name = a.car_name;
  plan.service.up_cap_kbit_s = a.budget_kbit;
  plan.service.utc_error = transport::utc_error;
  return true;
}

Result<bool, Problem> plan_web(const Arguments& a, Plan& plan, const LogLine& log) {
  plan.http.console = settings::console_folder(a.console_folder);
  plan.http.layouts = a.layouts_folder;
  const auto access = plan_access(a, plan.http.access);
  if (!access) return access;
  auto tls = tls_of(a, log);
  if (!tls) return Unexpected{tls.error()};
  plan.http.tls = *std::move(tls);
  plan.http.access.encrypted = plan.http.tls != nullptr;
  plan.console.tokens = plan.http.access.tokens;
  plan.service.second_person = !a.tokens_file.empty();
  const alarms::EvaluatorConfig& evaluator = plan.service.evaluator;
  const auto limit_of = [&](state::FieldId id) -> const alarms::Limit& {
    return evaluator.limits.of(id);
  };
  plan.http.documents.emplace(
      "/api/catalogue", console::catalogue_text(limit_of, evaluator.derive.fuel.attempt_laps));
  return true;
}

void plan_stamps(const Arguments& arguments, Plan& plan, const LogLine& log) {
  if (arguments.stamp_file == settings::kNoStampFile) return;
  plan.stamp_file =
      arguments.stamp_file.empty() ? link::stamp_file_of(arguments.keys) : arguments.stamp_file;
  const auto newest = link::read_stamp(plan.stamp_file);
  if (newest) {
    plan.config.association.newest_stamp = *newest;
  } else {
    log("stamp file unreadable: " + to_string(newest.error()) +
        "; begins without it, and the car's next session writes it anew");
  }
}

Result<bool, Problem> plan_radio(const Arguments& arguments, Plan& plan, const LogLine& log) {
  auto listen = addresses_of(arguments);
  if (!listen) return Unexpected{listen.error()};
  plan.listen = *std::move(listen);
  if (arguments.keys.empty()) {
    return Unexpected{
        Problem{"--keys", "expected a file of keys; pitwall-base keygen --out FOLDER makes them"}};
  }
  const auto keys = link::read_keys(arguments.keys, telemetry::Role::kBase);
  if (!keys) return Unexpected{keys.error()};
  plan.config.association.keys = *keys;
  plan_stamps(arguments, plan, log);
  if (keys->bench) {
    log(arguments.keys + ": KEYS OF A BENCH: sessions may be logged" +
        (arguments.key_log.empty() ? "" : ", and are: " + arguments.key_log));
  }
  if (!arguments.key_log.empty()) {
    auto key_log = link::key_log_to(arguments.key_log, *keys);
    if (!key_log) return Unexpected{key_log.error()};
    plan.config.association.key_log = *std::move(key_log);
  }
  plan.config.association.greeting.signed_only = arguments.signed_only;
  plan.config.association.paths = static_cast<std::uint8_t>(plan.listen.size());
  for (telemetry::BudgetParams& budget : plan.config.budget) {
    budget.bytes_per_s = arguments.budget_kbit * kBytesPerKbit;
    const auto made = telemetry::PathBudget::make(budget);
    if (!made) return Unexpected{Problem{"--budget", made.error().what}};
  }
  return true;
}

Result<bool, Problem> plan_hands(const Arguments& arguments, Plan& plan) {
  if (!arguments.command_file.empty()) {
    const auto text = transport::read_file(arguments.command_file);
    if (!text) return Unexpected{text.error()};
    auto script = inputs::CommandScript::parse(*text, arguments.command_file);
    if (!script) return Unexpected{script.error()};
    plan.script = *std::move(script);
  }
  const auto axes = inputs::JoystickMapping::parse(arguments.joystick_axes);
  if (!axes) return Unexpected{axes.error()};
  plan.joystick = *axes;
  return true;
}

std::string reported(const Arguments& car) { return "car " + std::to_string(car.car); }

}  // namespace

Result<bool, Problem> use_tokens(const std::string& file, web::AccessRules& access) {
  if (file.empty()) return true;
  auto tokens = web::TokenStore::open(file);
  if (!tokens) return Unexpected{tokens.error()};
  access.tokens = *std::move(tokens);
  return true;
}

Result<std::shared_ptr<ssl_ctx_st>, Problem> tls_of(const Arguments& a, const LogLine& log) {
  if (a.web_certificate.empty()) return std::shared_ptr<ssl_ctx_st>{};
  auto tls = web::read_tls_files(a.web_certificate, a.web_key);
  if (!tls) return Unexpected{tls.error()};
  if (!tls->warning.empty()) log(tls->warning);
  return std::move(tls->context);
}

Result<Plan, Problem> plan_of(const Arguments& arguments, const LogLine& log) {
  Plan plan{.arguments = arguments};
  auto planned = plan_radio(arguments, plan, log);
  if (planned) planned = plan_hands(arguments, plan);
  if (planned) planned = plan_service(arguments, plan, log);
  if (planned && arguments.web_port) planned = plan_web(arguments, plan, log);
  if (!planned) return Unexpected{planned.error()};
  return plan;
}

Result<std::vector<Plan>, Problem> plans_of(std::span<const Arguments> cars, const LogLine& log) {
  std::vector<Plan> plans;
  for (const Arguments& car : cars) {
    auto plan = plan_of(car, [&](const std::string& line) {
      log(cars.size() > 1 ? reported(car) + ": " + line : line);
    });
    if (!plan) {
      if (cars.size() == 1) return Unexpected{plan.error()};
      return Unexpected{Problem{reported(car) + ": " + plan.error().place, plan.error().what}};
    }
    for (const Plan& other : plans) {
      const telemetry::KeyFile &one = other.config.association.keys,
                               &two = plan->config.association.keys;
      if (one.own.public_key == two.own.public_key || one.peer == two.peer) {
        return Unexpected{
            Problem{reported(car) + ": " + car.keys,
                    reported(other.arguments) + " has the same keys; each car needs its own"}};
      }
      if (!plan->stamp_file.empty() && plan->stamp_file == other.stamp_file) {
        return Unexpected{Problem{
            reported(car) + ": " + plan->stamp_file,
            reported(other.arguments) + " has the same stamp file; each car needs its own"}};
      }
    }
    plan->console.place = plans.size();
    plans.push_back(*std::move(plan));
  }
  return plans;
}

Result<Plan, Problem> plan_of_replay(const Arguments& arguments, const LogLine& log) {
  Plan plan{.arguments = arguments};
  auto planned = plan_service(arguments, plan, log);
  if (planned) planned = plan_web(arguments, plan, log);
  if (!planned) return Unexpected{planned.error()};
  return plan;
}

web::HttpConfig served(std::span<Plan> plans) {
  web::HttpConfig http;
  std::vector<CarStatus> statuses;
  for (Plan& plan : plans) {
    if (statuses.empty()) {
      http.access = plan.http.access;
      http.console = plan.http.console;
      http.layouts = plan.http.layouts;
      http.tls = plan.http.tls;
    }
    http.cars.push_back(
        {.number = plan.arguments.car, .documents = std::move(plan.http.documents)});
    const bool replayed = !plan.arguments.replay_folder.empty();
    statuses.push_back({.number = plan.arguments.car,
                        .name = plan.arguments.car_name,
                        .mode = replayed ? "REPLAY" : "NONE"});
  }
  http.documents.emplace(kRosterPath, roster_text(statuses));
  http.documents.emplace(publishers::console::kRecordingsPath,
                         "");  // shown when it has been looked at
  return http;
}

}  // namespace pitwall::session

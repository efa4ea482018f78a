// SPDX-License-Identifier: Apache-2.0
#include "basestation/publishers/web/http_responder.hpp"

#include <algorithm>
#include <charconv>
#include <utility>

#include "basestation/publishers/web/admission/session_cookie.hpp"
#include "protocol/json/json_text.hpp"
#include "protocol/json/json_value.hpp"
#include "protocol/transport/file.hpp"

namespace pitwall::publishers::web {
namespace {

constexpr unsigned kOk = 200, kNoContent = 204, kBad = 400, kNoToken = 401, kForbidden = 403,
                   kNotFound = 404, kNoMethod = 405, kTooLarge = 413, kNoRoom = 507;
constexpr std::string_view kBearer = "Bearer ", kLayouts = "/api/layouts/",
                           kSession = "/api/session", kBenchPages = "/bench/";
// Scripts of the page run, in an origin of its own.
constexpr std::string_view kPolicyOfBench =
    "sandbox allow-scripts; default-src 'none'; style-src 'unsafe-inline'; "
    "script-src 'unsafe-inline'; img-src data:; form-action 'none'; base-uri 'none'; "
    "frame-ancestors 'none'";

std::shared_ptr<const std::string> shared(std::string text) {
  return std::make_shared<const std::string>(std::move(text));
}

// There might be one, and there is none: no reason for a browser to complain.
HttpAnswer nothing() {
  HttpAnswer answer;
  answer.status = kNoContent;
  answer.cache = "no-store";
  return answer;
}

std::string policy_for(std::string_view host) {
  std::string sockets;
  // Not every browser counts a WebSocket of the same host as 'self'.
  if (host.find_first_not_of(
          "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789.-:[]") ==
          std::string_view::npos &&
      !host.empty()) {
    sockets = " ws://" + std::string{host} + " wss://" + std::string{host};
  }
  return "default-src 'self'; connect-src 'self'" + sockets +
         "; img-src 'self' data:; object-src 'none'; base-uri 'none'; form-action 'none'; "
         "frame-ancestors 'none'";
}

bool is_layout_name(std::string_view name) {
  return !name.empty() && name.size() <= HttpResponder::kNameMax &&
         std::ranges::all_of(name, [](char c) {
           return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                  c == '-' || c == '_';
         });
}

constexpr std::string_view kNotBuilt = R"(<!doctype html>
<html lang="en"><head><meta charset="utf-8"><title>Pitwall: console not built</title></head>
<body><h1>The console has not been built</h1>
<p>The base station runs and serves its data, but found no index.html in the folder of the
console. Build it with <code>./pitwall build</code>, or name its folder with
<code>--console-dir</code>, and load this page again.</p></body></html>
)";

}  // namespace

HttpAnswer refusal(unsigned status, std::string_view why) {
  HttpAnswer answer;
  answer.status = status;
  answer.body = shared(std::string{why} + "\n");
  answer.cache = "no-store";
  answer.policy = "default-src 'none'";
  return answer;
}

HttpAnswer page_of_bench(std::string html) {
  HttpAnswer answer;
  answer.type = type_of("index.html");
  answer.body = shared(std::move(html));
  answer.cache = "no-store";
  answer.policy = kPolicyOfBench;
  return answer;
}

std::string_view query_value(std::string_view target, std::string_view name) {
  const std::size_t mark = target.find('?');
  std::string_view rest =
      mark == std::string_view::npos ? std::string_view{} : target.substr(mark + 1);
  while (!rest.empty()) {
    const std::string_view pair = rest.substr(0, rest.find('&'));
    rest.remove_prefix(std::min(rest.size(), pair.size() + 1));
    if (pair.starts_with(name) && pair.size() > name.size() && pair[name.size()] == '=') {
      return pair.substr(name.size() + 1);
    }
  }
  return {};
}

HttpResponder::HttpResponder(HttpConfig config)
    : config_(std::move(config)), files_(config_.console) {
  for (auto& [path, text] : config_.documents) show(path, {std::move(text), kJsonType});
  for (ServedCar& car : config_.cars) {
    Kept& kept = of_cars_.emplace_back();
    for (auto& [path, text] : car.documents) kept[path] = {.text = shared(std::move(text))};
  }
}

void HttpResponder::show(const std::string& path, Shown document) {
  documents_[path] = {.text = shared(std::move(document.text)), .type = document.type};
}

// Nothing: a number that is none, or of no car here.
std::optional<std::size_t> HttpResponder::car_of(std::string_view target) const {
  if (target.find("?car=") == target.npos && target.find("&car=") == target.npos) return 0;
  return car_of_number(query_value(target, "car"));
}

std::optional<std::size_t> HttpResponder::car_of_number(std::string_view asked) const {
  int number = -1;
  const auto read = std::from_chars(asked.data(), asked.data() + asked.size(), number);
  if (read.ec != std::errc{} || read.ptr != asked.data() + asked.size()) return std::nullopt;
  const auto found = std::ranges::find(config_.cars, number, &ServedCar::number);
  if (found == config_.cars.end()) return std::nullopt;
  return static_cast<std::size_t>(found - config_.cars.begin());
}

const HttpResponder::Document* HttpResponder::document(std::string_view path,
                                                       std::size_t car) const {
  if (car < of_cars_.size()) {
    const auto own = of_cars_[car].find(path);
    if (own != of_cars_[car].end()) return &own->second;
  }
  const auto common = documents_.find(path);
  return common == documents_.end() ? nullptr : &common->second;
}

HttpAnswer HttpResponder::answer(const HttpQuestion& question) {
  std::string_view path = question.target.substr(0, question.target.find('?'));
  const std::string_view token = token_of(question, path);
  if (token_is_path() && !token.empty()) path = "/";
  HttpAnswer answer;
  auto who = visitor_of(question, token);
  // The page itself tells nobody anything: it has to come before somebody can show a token.
  const bool of_the_page = !who && who.error() == Refused::kToken && token.empty();
  if (!who && who.error() != Refused::kToken) {
    answer = refusal(kForbidden, text_of(who.error()));
  } else if (config_.subprotocols.empty() && !query_value(question.target, "token").empty()) {
    answer = refusal(kBad,
                     "a token must not be part of the address: log in, or send the header "
                     "Authorization: Bearer TOKEN");
  } else if (config_.subprotocols.empty() && path == kSession) {
    answer = session(question, who);
  } else if (who || (of_the_page && is_console_file(question, path))) {
    answer = serve(question, path, who ? *who : Identity{});
  } else {
    answer = refusal(kNoToken, text_of(who.error()));
  }
  answer.policy = policy_for(question.host);
  return answer;
}

Result<Identity, Refused> HttpResponder::visitor_of(const HttpQuestion& question,
                                                    std::string_view token) const {
  std::string_view session = session_of(question.cookie, port_);
  if (session.empty() && question.target.starts_with(kBenchPages))
    session = page_session_of(question.cookie, port_);
  return admit(
      config_.access,
      {.host = question.host, .origin = question.origin, .token = token, .session = session},
      config_.utc());
}

// Who this browser is; logs in and out.
HttpAnswer HttpResponder::session(const HttpQuestion& question,
                                  const Result<Identity, Refused>& who) const {
  if (question.method == "POST") return log_in(question);
  HttpAnswer answer;
  answer.cache = "no-store";
  if (question.method == "DELETE") {
    answer.status = kNoContent;
    answer.set_cookies = cookies_for(question, "");
    return answer;
  }
  if (question.method != "GET") {
    answer = refusal(kNoMethod, "expected GET, POST or DELETE");
    answer.allow = "GET, POST, DELETE";
    return answer;
  }
  if (!who) return refusal(kNoToken, text_of(who.error()));
  answer.type = kJsonType;
  answer.body = shared(json::Object{}
                           .text("role", text_of(who->role))
                           .text("name", who->name)
                           .flag("logged_in", !who->token_id.empty())
                           .str());
  return answer;
}

HttpAnswer HttpResponder::log_in(const HttpQuestion& question) const {
  const auto asked = json::JsonValue::parse(question.body, "login");
  const std::string token = asked ? asked->text("token") : std::string{};
  if (token.empty()) return refusal(kBad, R"(expected {"token": "..."})");
  const std::string session =
      config_.access.tokens->session(token, {config_.utc().ns + kSessionLasts.ns});
  if (session.empty()) return refusal(kNoToken, text_of(Refused::kToken));
  HttpAnswer answer;
  answer.status = kNoContent;
  answer.cache = "no-store";
  answer.set_cookies = cookies_for(question, session);
  return answer;
}

// A proxy that says TLS for a request that had none makes a cookie that the browser keeps to TLS.
std::vector<std::string> HttpResponder::cookies_for(const HttpQuestion& question,
                                                    std::string_view session) const {
  const bool secure = config_.access.encrypted || question.forwarded_proto == "https";
  return {set_cookie(port_, secure, session), set_page_cookie(port_, secure, kBenchPages, session)};
}

// Where a port of another protocol takes tokens.
bool HttpResponder::token_is_path() const {
  return !config_.subprotocols.empty() && !config_.access.default_role;
}

std::string_view HttpResponder::token_of(const HttpQuestion& question,
                                         std::string_view path) const {
  if (token_is_path()) return path.starts_with('/') ? path.substr(1) : path;
  return question.authorization.starts_with(kBearer) ? question.authorization.substr(kBearer.size())
                                                     : std::string_view{};
}

bool HttpResponder::is_console_file(const HttpQuestion& question, std::string_view path) const {
  return config_.subprotocols.empty() && !question.upgrade && path != "/ws" &&
         !path.starts_with("/api/") && !path.starts_with(kBenchPages) &&
         !config_.made.contains(path);
}

// The first of those offered that is ours.
HttpAnswer HttpResponder::open_foreign(const HttpQuestion& question, std::string_view path,
                                       const Identity& who) const {
  if (path != "/") return refusal(kNotFound, "the WebSocket is at /");
  if (!question.upgrade) return refusal(kBad, "this port is a WebSocket");
  std::string_view rest = question.subprotocols;
  while (!rest.empty()) {
    std::string_view offered = rest.substr(0, rest.find(','));
    rest.remove_prefix(std::min(rest.size(), offered.size() + 1));
    offered.remove_prefix(std::min(offered.find_first_not_of(" \t"), offered.size()));
    offered = offered.substr(0, offered.find_last_not_of(" \t") + 1);
    const auto ours = std::ranges::find(config_.subprotocols, offered);
    if (ours == config_.subprotocols.end()) continue;
    HttpAnswer answer;
    answer.visitor = who;
    answer.subprotocol = *ours;
    return answer;
  }
  std::string known;
  for (const std::string_view name : config_.subprotocols) known += " " + std::string{name};
  return refusal(kBad, "expected one of the subprotocols:" + known);
}

HttpAnswer HttpResponder::serve(const HttpQuestion& question, std::string_view path,
                                const Identity& who) {
  if (!config_.subprotocols.empty()) return open_foreign(question, path, who);
  const bool of_a_car = path == "/ws" || path.starts_with("/api/");
  const auto car = of_a_car ? car_of(question.target) : 0;
  if (!car) return refusal(kNotFound, "this base has no car of that number");
  if (path == "/ws") {
    if (!question.upgrade) return refusal(kBad, "/ws is a WebSocket");
    HttpAnswer answer;
    answer.visitor = who;
    answer.car = *car;
    return answer;
  }
  if (path.starts_with(kLayouts)) return layout(question, path.substr(kLayouts.size()), who);
  if (question.method != "GET" && question.method != "HEAD") {
    HttpAnswer answer = refusal(kNoMethod, "expected GET or HEAD");
    answer.allow = "GET, HEAD";
    return answer;
  }
  if (path.starts_with(kBenchPages)) return bench_page(path.substr(kBenchPages.size()));
  if (const auto maker = config_.made.find(path); maker != config_.made.end()) {
    Shown made = maker->second();
    HttpAnswer answer;
    answer.type = made.type;
    answer.cache = "no-store";
    answer.body = shared(std::move(made.text));
    return answer;
  }
  const Document* const known = document(path, *car);
  if (known == nullptr) return file(question, path);
  if (known->text->empty()) return nothing();
  HttpAnswer answer;
  answer.type = known->type;
  answer.body = known->text;
  return answer;
}

// "1/sweeps/grip/report.html": the number of the car, and the page.
HttpAnswer HttpResponder::bench_page(std::string_view path) const {
  const std::size_t slash = std::min(path.find('/'), path.size());
  const auto car = car_of_number(path.substr(0, slash));
  if (!car) return refusal(kNotFound, "this base has no car of that number");
  HttpAnswer answer;
  answer.car = *car;
  answer.page = path.substr(std::min(slash + 1, path.size()));
  return answer.page.empty() ? refusal(kNotFound, "expected the name of a page") : answer;
}

HttpAnswer HttpResponder::file(const HttpQuestion& question, std::string_view path) {
  const ServedFile* const file = files_.find(path);
  HttpAnswer answer;
  if (file == nullptr) {
    if (path != "/") return refusal(kNotFound, "no file of that name");
    answer.type = type_of("index.html");
    answer.body = shared(std::string{kNotBuilt});
    return answer;
  }
  answer.gzipped =
      file->gzipped != nullptr && question.accept_encoding.find("gzip") != std::string_view::npos;
  answer.body = answer.gzipped ? file->gzipped : file->bytes;
  answer.type = file->type;
  if (file->forever) answer.cache = "public, max-age=31536000, immutable";
  return answer;
}

HttpAnswer HttpResponder::layout(const HttpQuestion& question, std::string_view name,
                                 const Identity& who) {
  if (!is_layout_name(name))
    return refusal(kNotFound, "expected a layout name of letters and digits");
  if (question.method == "PUT") {
    if (who.role != Role::kOperator)
      return refusal(kForbidden, "only an operator can save a layout");
    return put_layout(name, question.body);
  }
  if (question.method != "GET") {
    HttpAnswer answer = refusal(kNoMethod, "expected GET or PUT");
    answer.allow = "GET, PUT";
    return answer;
  }
  HttpAnswer answer;
  answer.type = kJsonType;
  answer.cache = "no-store";
  if (const auto kept = layouts_.find(name); kept != layouts_.end()) {
    answer.body = kept->second;
    return answer;
  }
  if (config_.layouts.empty()) return nothing();
  auto text =
      transport::read_file(config_.layouts + "/" + std::string{name} + ".json", kLayoutBytes);
  if (!text) return nothing();
  answer.body = shared(*std::move(text));
  return answer;
}

HttpAnswer HttpResponder::put_layout(std::string_view name, std::string_view body) {
  if (body.size() > kLayoutBytes) return refusal(kTooLarge, "the layout is larger than 256 KiB");
  const auto value = json::JsonValue::parse(body, "layout");
  if (!value) return refusal(kBad, to_string(value.error()));
  if (!value->is_object()) return refusal(kBad, "layout: expected a JSON object");
  if (!layouts_.contains(name) && layouts_.size() >= kLayoutsMax) {
    return refusal(kNoRoom, "100 layouts are saved already, and no more fit");
  }
  if (!config_.layouts.empty()) {
    const auto written =
        transport::write_file(config_.layouts + "/" + std::string{name} + ".json", body);
    if (!written) return refusal(kNoRoom, to_string(written.error()));
  }
  layouts_.insert_or_assign(std::string{name}, shared(std::string{body}));
  HttpAnswer answer;
  answer.status = kOk;
  answer.body = shared("kept\n");
  return answer;
}

}  // namespace pitwall::publishers::web

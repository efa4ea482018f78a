// SPDX-License-Identifier: Apache-2.0
#include "basestation/outlets/web/http_desk.hpp"

#include <algorithm>
#include <utility>

#include "protocol/json/json_value.hpp"
#include "protocol/transport/file.hpp"

namespace pitwall::outlets::web {
namespace {

constexpr unsigned kOk = 200, kNoContent = 204, kBad = 400, kNoToken = 401, kForbidden = 403,
                   kNotFound = 404, kNoMethod = 405, kTooLarge = 413, kNoRoom = 507;
constexpr std::string_view kJson = "application/json", kBearer = "Bearer ",
                           kLayouts = "/api/layouts/";

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
    sockets = " ws://" + std::string{host};
  }
  return "default-src 'self'; connect-src 'self'" + sockets +
         "; img-src 'self' data:; object-src 'none'; base-uri 'none'; form-action 'none'; "
         "frame-ancestors 'none'";
}

bool is_layout_name(std::string_view name) {
  return !name.empty() && name.size() <= HttpDesk::kNameMax &&
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

HttpDesk::HttpDesk(HttpConfig config) : config_(std::move(config)), files_(config_.console) {
  for (auto& [path, text] : config_.documents) documents_.emplace(path, shared(std::move(text)));
}

HttpAnswer HttpDesk::answer(const HttpQuestion& question) {
  const std::string_view token = question.authorization.starts_with(kBearer)
                                     ? question.authorization.substr(kBearer.size())
                                     : query_value(question.target, "token");
  const auto who =
      admit(config_.access, {.host = question.host, .origin = question.origin, .token = token});
  HttpAnswer answer =
      who ? serve(question, question.target.substr(0, question.target.find('?')), *who)
          : refusal(who.error() == Refused::kToken ? kNoToken : kForbidden, text_of(who.error()));
  answer.policy = policy_for(question.host);
  return answer;
}

HttpAnswer HttpDesk::serve(const HttpQuestion& question, std::string_view path,
                           const Identity& who) {
  if (path == "/ws") {
    if (!question.upgrade) return refusal(kBad, "/ws is a WebSocket");
    HttpAnswer answer;
    answer.visitor = who;
    return answer;
  }
  if (path.starts_with(kLayouts)) return layout(question, path.substr(kLayouts.size()), who);
  if (question.method != "GET" && question.method != "HEAD") {
    HttpAnswer answer = refusal(kNoMethod, "only GET and HEAD here");
    answer.allow = "GET, HEAD";
    return answer;
  }
  const auto document = documents_.find(path);
  if (document == documents_.end()) return file(question, path);
  if (document->second->empty()) return nothing();
  HttpAnswer answer;
  answer.type = kJson;
  answer.body = document->second;
  return answer;
}

HttpAnswer HttpDesk::file(const HttpQuestion& question, std::string_view path) {
  const ServedFile* const file = files_.find(path);
  HttpAnswer answer;
  if (file == nullptr) {
    if (path != "/") return refusal(kNotFound, "nothing of that name here");
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

HttpAnswer HttpDesk::layout(const HttpQuestion& question, std::string_view name,
                            const Identity& who) {
  if (!is_layout_name(name)) return refusal(kNotFound, "a layout's name has letters and digits");
  if (question.method == "PUT") {
    if (who.role != Role::kOperator) return refusal(kForbidden, "layouts are kept by operators");
    return put_layout(name, question.body);
  }
  if (question.method != "GET") {
    HttpAnswer answer = refusal(kNoMethod, "only GET and PUT here");
    answer.allow = "GET, PUT";
    return answer;
  }
  HttpAnswer answer;
  answer.type = kJson;
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

HttpAnswer HttpDesk::put_layout(std::string_view name, std::string_view body) {
  if (body.size() > kLayoutBytes) return refusal(kTooLarge, "a layout has at most 256 KiB");
  const auto value = json::JsonValue::parse(body, "layout");
  if (!value) return refusal(kBad, to_string(value.error()));
  if (!value->is_object()) return refusal(kBad, "a layout is an object");
  if (!layouts_.contains(name) && layouts_.size() >= kLayoutsMax) {
    return refusal(kNoRoom, "a hundred layouts are kept already");
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

}  // namespace pitwall::outlets::web

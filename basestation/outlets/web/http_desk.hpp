// What an HTTP request is answered, without any socket: the console's files, the documents of the
// base, layouts.
//   in     a request: method, target, the headers that matter, its body
//   out    status, headers, bytes; or that it is the socket's, and who comes
//   law    every answer carries the policy that keeps foreign scripts out; a refusal is one line of
//          text that says why
//   bound  kLayoutsMax layouts of kLayoutBytes; the folder keeps them, without one they last as
//          long as the base runs
//   errors 204 nobody has stored that layout, or there is no such document here; 400 no layout, 401
//          token, 403 origin, host or role, 404, 405, 413, 507 no room
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "basestation/outlets/web/access.hpp"
#include "basestation/outlets/web/client.hpp"
#include "basestation/outlets/web/console_files.hpp"

namespace pitwall::outlets::web {

struct HttpQuestion {
  std::string_view method{}, target{};
  std::string_view host{}, origin{}, authorization{}, accept_encoding{};
  bool upgrade = false;  // asks for a WebSocket
  std::string_view body{};
};

struct HttpAnswer {
  unsigned status = 200;
  std::string_view type = "text/plain; charset=utf-8";
  std::shared_ptr<const std::string> body;
  bool gzipped = false;
  std::string_view cache = "no-cache";
  std::string policy;               // Content-Security-Policy
  std::string_view allow;           // of a 405
  std::optional<Identity> visitor;  // set: to be upgraded
};

struct HttpConfig {
  AccessRules access{};
  std::filesystem::path console{};
  std::map<std::string, std::string, std::less<>> documents{};  // by path: JSON or nothing
  std::string layouts{};                                        // a folder; empty: in memory
};

class HttpDesk {
 public:
  static constexpr std::size_t kLayoutBytes = 256 * 1'024, kLayoutsMax = 100, kNameMax = 40;

  explicit HttpDesk(HttpConfig config);
  HttpAnswer answer(const HttpQuestion& question);
  const AccessRules& access() const { return config_.access; }

 private:
  HttpAnswer serve(const HttpQuestion& question, std::string_view path, const Identity& who);
  HttpAnswer file(const HttpQuestion& question, std::string_view path);
  HttpAnswer layout(const HttpQuestion& question, std::string_view name, const Identity& who);
  HttpAnswer put_layout(std::string_view name, std::string_view body);

  HttpConfig config_;
  ConsoleFiles files_;
  std::map<std::string, std::shared_ptr<const std::string>, std::less<>> documents_, layouts_;
};

HttpAnswer refusal(unsigned status, std::string_view why);
// The value of "name=" after the question mark; percent signs are not undone: tokens have none.
std::string_view query_value(std::string_view target, std::string_view name);

}  // namespace pitwall::outlets::web

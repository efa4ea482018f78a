// HTTP responses, without a socket: the console's files, the documents of the base and of each of
// its cars, layouts.
//   in     a request: method, target, the headers that matter, its body; documents of the moment
//   out    status, headers, bytes; or that it is the socket's, who comes, and to which car
//   invariants
//          every answer carries the policy that keeps foreign scripts out; a refusal is one line of
//          text that says why
//          ?car=NUMBER names the car that is meant; without it the first is. A number that is not
//          served here is refused: nobody gets another car than the one he asked for
//          a token comes in a header, or once in the body of a login, which is answered with a
//          session's cookie; never in an address, where histories and logs would keep it
//   bound  kLayoutsMax layouts of kLayoutBytes; the folder keeps them, without one they last as
//          long as the base runs
//   errors 204 nobody has stored that layout, or there is no such document here; 400 no layout, 401
//          token, 403 origin, host or role, 404, 405, 413, 507 no room
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "basestation/publishers/web/admission/access.hpp"
#include "basestation/publishers/web/client.hpp"
#include "basestation/publishers/web/client_queue.hpp"
#include "basestation/publishers/web/console_files.hpp"
#include "protocol/transport/clock.hpp"

struct ssl_ctx_st;

namespace pitwall::publishers::web {

struct HttpQuestion {
  std::string_view method{}, target{};
  std::string_view host{}, origin{}, authorization{}, accept_encoding{};
  std::string_view subprotocols{};  // that are offered for a WebSocket: "a, b"
  std::string_view cookie{}, forwarded_proto{};
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
  std::string set_cookie;           // of a login
  std::string_view allow;           // of a 405
  std::optional<Identity> visitor;  // set: to be upgraded
  std::size_t car = 0;              // that the visitor comes to, in the order of the cars
  std::string_view subprotocol{};   // that the socket speaks; empty: the console's own
};

// By path: JSON or nothing.
using Documents = std::map<std::string, std::string, std::less<>>;

struct ServedCar {
  int number = 0;
  Documents documents{};  // those of this car
};

// A document of the moment.
struct Shown {
  std::string text;
  std::string_view type;  // of content, of static life
};

struct HttpConfig {
  AccessRules access{};
  std::filesystem::path console{};
  Documents documents{};          // whatever the car
  std::vector<ServedCar> cars{};  // empty: one, and its number does not matter
  std::string layouts{};          // a folder; empty: in memory
  // Documents that are made when they are asked for, by the thread that answers.
  std::map<std::string, std::function<Shown()>, std::less<>> made{};
  // Not empty: this is the port of another protocol, a WebSocket that speaks one of these, at / or,
  // with a token, at /TOKEN.
  std::vector<std::string_view> subprotocols{};
  QueueLimits queue{};                // of each client
  std::shared_ptr<ssl_ctx_st> tls{};  // set: TLS and nothing else
  std::function<UtcTime()> utc = transport::utc_now;
  // What a person at the base should know; called by the thread that answers.
  std::function<void(const std::string&)> say = [](const std::string&) {};
};

inline constexpr std::string_view kJsonType = "application/json";

class HttpResponder {
 public:
  static constexpr std::size_t kLayoutBytes = 256 * 1'024, kLayoutsMax = 100, kNameMax = 40;

  explicit HttpResponder(HttpConfig config);
  HttpAnswer answer(const HttpQuestion& question);
  // From now on, for every car.
  void show(const std::string& path, Shown document);
  const HttpConfig& config() const { return config_; }
  // Of the server that it answers for: part of the cookie's name.
  void serve_at(std::uint16_t port) { port_ = port; }

 private:
  struct Document {
    std::shared_ptr<const std::string> text;
    std::string_view type = kJsonType;
  };
  using Kept = std::map<std::string, Document, std::less<>>;

  Result<Identity, Refused> visitor_of(const HttpQuestion& question, std::string_view token) const;
  HttpAnswer serve(const HttpQuestion& question, std::string_view path, const Identity& who);
  HttpAnswer session(const HttpQuestion& question, const Result<Identity, Refused>& who) const;
  HttpAnswer log_in(const HttpQuestion& question) const;
  std::string cookie_for(const HttpQuestion& question, std::string_view session) const;
  bool token_is_path() const;
  std::string_view token_of(const HttpQuestion& question, std::string_view path) const;
  bool is_console_file(const HttpQuestion& question, std::string_view path) const;
  HttpAnswer open_foreign(const HttpQuestion& question, std::string_view path,
                          const Identity& who) const;
  std::optional<std::size_t> car_of(std::string_view target) const;
  const Document* document(std::string_view path, std::size_t car) const;
  HttpAnswer file(const HttpQuestion& question, std::string_view path);
  HttpAnswer layout(const HttpQuestion& question, std::string_view name, const Identity& who);
  HttpAnswer put_layout(std::string_view name, std::string_view body);

  HttpConfig config_;
  std::uint16_t port_ = 0;
  ConsoleFiles files_;
  Kept documents_;
  std::vector<Kept> of_cars_;
  std::map<std::string, std::shared_ptr<const std::string>, std::less<>> layouts_;
};

HttpAnswer refusal(unsigned status, std::string_view why);
// The value of "name=" after the question mark; percent signs are not undone: tokens have none.
std::string_view query_value(std::string_view target, std::string_view name);

}  // namespace pitwall::publishers::web

// HTTP responses, without a socket: the console's files, the documents of the base and of each of
// its cars, layouts.
//   in     a request: method, target, headers, body; present documents
//   out    status, headers, bytes; or an upgrade to a WebSocket with the client's identity and car
//   invariants
//          every answer carries the policy that keeps foreign scripts out; a refusal is one line of
//          text with the reason
//          ?car=NUMBER selects the car; without it, the first one. A number that this base does not
//          serve is refused, so that no client gets another car than requested
//          a token comes in a header, or once in the body of a login, whose answer sets the session
//          cookie; never in an address, which histories and logs keep. Only a port of another
//          protocol takes it as its path
//          a page of a bench, /bench/CAR/..., is asked for elsewhere, and served as a foreign page
//   bound  kLayoutsMax layouts of kLayoutBytes, stored in the folder; without a folder, in memory
//          until the base ends
//   errors 204 no such layout stored, or no such document here; 400 not a layout, 401 token, 403
//          origin, host or role, 404, 405, 413, 507 no room
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
#include "basestation/publishers/web/admission/client.hpp"
#include "basestation/publishers/web/client_queue.hpp"
#include "basestation/publishers/web/console_files.hpp"
#include "protocol/transport/clock.hpp"

struct ssl_ctx_st;

namespace pitwall::publishers::web {

struct HttpQuestion {
  std::string_view method{}, target{};
  std::string_view host{}, origin{}, authorization{}, accept_encoding{};
  std::string_view subprotocols{};  // offered for a WebSocket: "a, b"
  std::string_view cookie{}, forwarded_proto{};
  bool upgrade = false;  // to a WebSocket
  std::string_view body{};
};

struct HttpAnswer {
  unsigned status = 200;
  std::string_view type = "text/plain; charset=utf-8";
  std::shared_ptr<const std::string> body;
  bool gzipped = false;
  std::string_view cache = "no-cache";
  std::string policy;                      // Content-Security-Policy
  std::vector<std::string> set_cookies{};  // of a login
  std::string_view allow;                  // of a 405
  std::optional<Identity> visitor;         // not empty: upgrade this client to a WebSocket
  std::size_t car = 0;                     // of the visitor or the page, in the order of the cars
  std::string page{};  // not empty: the answer is this page of the car's bench, to be asked for
  std::string_view subprotocol{};  // of the WebSocket; empty: the console's own
};

// JSON texts by path; an empty text is answered as "no such document".
using Documents = std::map<std::string, std::string, std::less<>>;

struct ServedCar {
  int number = 0;
  Documents documents{};  // of this car
};

// Document with its content type.
struct Shown {
  std::string text;
  std::string_view type;  // of the content; static lifetime
};

struct HttpConfig {
  AccessRules access{};
  std::filesystem::path console{};
  Documents documents{};          // for all cars
  std::vector<ServedCar> cars{};  // empty: one car, whose number is not checked
  std::string layouts{};          // a folder; empty: in memory
  // Documents that are made per request, by the thread that answers.
  std::map<std::string, std::function<Shown()>, std::less<>> made{};
  // Not empty: this is the port of another protocol, a WebSocket with one of these subprotocols, at
  // / or, with a token, at /TOKEN.
  std::vector<std::string_view> subprotocols{};
  QueueLimits queue{};                // of each client
  std::shared_ptr<ssl_ctx_st> tls{};  // not null: TLS only
  std::function<UtcTime()> utc = transport::utc_now;
  // Log line for the operator of the base; called by the thread that answers.
  std::function<void(const std::string&)> log = [](const std::string&) {};
};

inline constexpr std::string_view kJsonType = "application/json";

class HttpResponder {
 public:
  static constexpr std::size_t kLayoutBytes = 256 * 1'024, kLayoutsMax = 100, kNameMax = 40;

  explicit HttpResponder(HttpConfig config);
  HttpAnswer answer(const HttpQuestion& question);
  // Adds or replaces a document for all cars.
  void show(const std::string& path, Shown document);
  const HttpConfig& config() const { return config_; }
  // Sets the port of the server, which is part of the cookie's name.
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
  std::vector<std::string> cookies_for(const HttpQuestion& question,
                                       std::string_view session) const;
  bool token_is_path() const;
  std::string_view token_of(const HttpQuestion& question, std::string_view path) const;
  bool is_console_file(const HttpQuestion& question, std::string_view path) const;
  HttpAnswer open_foreign(const HttpQuestion& question, std::string_view path,
                          const Identity& who) const;
  HttpAnswer bench_page(std::string_view path) const;
  std::optional<std::size_t> car_of(std::string_view target) const;
  std::optional<std::size_t> car_of_number(std::string_view number) const;
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
// Page of a bench, foreign to the base: it cannot reach the base, its cookies or the network.
HttpAnswer page_of_bench(std::string html);
// Value of "name=" in the query; percent escapes are not decoded, because tokens have none.
std::string_view query_value(std::string_view target, std::string_view name);

}  // namespace pitwall::publishers::web

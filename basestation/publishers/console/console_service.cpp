// SPDX-License-Identifier: Apache-2.0
#include "basestation/publishers/console/console_service.hpp"

#include <utility>
#include <variant>

#include "basestation/publishers/console/catalogue_text.hpp"
#include "protocol/transport/clock.hpp"

namespace pitwall::publishers::console {
namespace {

// A crowd that speaks at once keeps neither the radio nor an operator waiting: what is left over
// wakes the loop again.
constexpr std::size_t kNewsPerTurn = 32;

constexpr unsigned kNotFound = 404, kUnavailable = 503;  // of HTTP
constexpr const char* kNoBench = "this base knows of no bench server (--bench)";

web::HttpAnswer http_answer_of(const bench::PageAnswer& answer) {
  using enum bench::PageAnswer::Kind;
  if (answer.kind == kPage) return web::page_of_bench(answer.text);
  return web::refusal(answer.kind == kRefused ? kNotFound : kUnavailable, answer.text);
}

std::string catalogue_of(const service::CarService& car) {
  const alarms::Evaluator& evaluator = car.evaluator();
  return catalogue_text(
      [&](state::FieldId id) -> const alarms::Limit& { return evaluator.limits().of(id); },
      evaluator.params().fuel.attempt_laps);
}

}  // namespace

ConsoleService::ConsoleService(ConsoleConfig config, service::CarService& car,
                               web::WebServer& server)
    : config_(std::move(config)),
      car_(car),
      server_(server),
      clients_(catalogue_of(car), car.messages()),
      catalogue_of_(car.identity().alarm_config) {
  car.messages().subscribe([this](std::string_view type, std::string_view text, Instant) {
    if (type != "hello") clients_.send_to_all(std::string{text});
  });
}

void ConsoleService::submit(service::CarService& car, Instant now) {
  for (std::size_t taken = 0; taken < kNewsPerTurn; ++taken) {
    const auto news = server_.next_event(config_.place);
    if (!news) return;
    switch (news->kind) {
      case web::ClientEvent::Kind::kJoined:
        clients_.joined(news->client, news->who, now);
        break;
      case web::ClientEvent::Kind::kLeft:
        car.requests().left(clients_.person(news->client), now);
        clients_.left(news->client);
        break;
      case web::ClientEvent::Kind::kText:
        if (const auto request = clients_.receive_text(news->client, news->text, *this, now)) {
          execute(news->client, *request, now);
        }
        break;
      case web::ClientEvent::Kind::kBinary:
        clients_.receive_binary(news->client);
        break;
      case web::ClientEvent::Kind::kPage:
        ask_page(news->request, news->text);
        break;
    }
  }
}

void ConsoleService::execute(web::ClientId client, const Request& request, Instant now) {
  const command::Person by = clients_.person(client);
  Result<bool, Problem> done = true;
  if (const auto* const ask = std::get_if<command::Request>(&request)) {
    done = car_.requests().execute(*ask, by, now);
  } else if (const auto* const ask_send = std::get_if<AskSend>(&request)) {
    done = car_.requests().execute(with_second_person(*ask_send), by, now);
  } else if (const auto* const ask_mark = std::get_if<AskMark>(&request)) {
    car_.mark(ask_mark->text, by, now);
  } else if (const auto* const ask_of_bench = std::get_if<AskBench>(&request)) {
    done = ask_bench(*ask_of_bench, by, now);
  } else if (std::holds_alternative<AskPlayback>(request)) {
    done = Unexpected{Problem{"playback", "this base shows a live car, not a replay"}};
  }
  if (!done) clients_.send_error(client, done.error());
}

command::Request ConsoleService::with_second_person(const AskSend& ask) const {
  command::SendTicket send{.ticket = ask.ticket};
  if (!ask.overrides) return send;
  send.overriding = command::Override{.reason = ask.reason, .second = {}};
  // A second person is known by a token of an operator; nobody else is one.
  const auto who = config_.tokens->find(ask.token);
  if (who && who->role == web::Role::kOperator) send.overriding->second.name = who->name;
  return send;
}

// The bench is no car: it takes an operator, and no authority.
Result<bool, Problem> ConsoleService::ask_bench(const AskBench& ask, const command::Person& by,
                                                Instant now) {
  Result<bool, Problem> asked = bench_ != nullptr
                                    ? bench_->ask(ask.run_request, by.console, by.name)
                                    : Result<bool, Problem>{Unexpected{Problem{"bench", kNoBench}}};
  car_.requests().note(by, text_of(ask.run_request),
                       asked ? "sent" : "refused: " + asked.error().what, now);
  return asked;
}

void ConsoleService::ask_page(std::uint64_t request, const std::string& page) {
  if (bench_ != nullptr) return bench_->ask_page(request, page);
  server_.answer(request, web::refusal(kNotFound, kNoBench));
}

void ConsoleService::attach(bench::BenchLink& bench) {
  bench_ = &bench;
  bench.observe_by({.publish =
                        [this](const bench::Reported& reported, Instant now) {
                          service::MessageLog& log = car_.messages();
                          if (reported.line) return log.add_line(reported.type, reported.text, now);
                          log.set_state(reported.type, reported.text, now);
                        },
                    .refused =
                        [this](std::uint8_t client, const Problem& problem, Instant now) {
                          car_.requests().note(clients_.person(client), "bench",
                                               "refused: " + problem.what, now);
                          clients_.send_error(client, problem);
                        },
                    .page =
                        [this](const bench::PageAnswer& answer) {
                          server_.answer(answer.request, http_answer_of(answer));
                        }});
}

void ConsoleService::publish(const service::CarService& car, Instant now) {
  if (car.evaluator().link_state() != link_shown_) clients_.receive();
  link_shown_ = car.evaluator().link_state();
  const service::CarIdentity identity = car.identity();
  clients_.identify(identity, now);
  if (identity.alarm_config != catalogue_of_) clients_.send_catalogue(catalogue_of(car));
  catalogue_of_ = identity.alarm_config;
  if (auto text = pauses_.news(transport::bench_pause(), now))
    car_.messages().set_state("bench_time", *std::move(text), now);
  clients_.serve(*this, transport::utc_now(), now);
  for (Sending& sending : clients_.take()) server_.send(sending.to, std::move(sending.message));
}

state::FieldView ConsoleService::view(state::FieldId id, Instant now) const {
  return car_.view(id, now);
}

alarms::Evaluation ConsoleService::evaluate(state::FieldId id, const state::FieldView& v) const {
  return car_.evaluator().evaluate(id, v);
}

std::vector<state::TrendPoint> ConsoleService::past(state::FieldId id, Instant from, Instant to,
                                                    std::size_t points) const {
  return car_.past(id, from, to, points);
}

}  // namespace pitwall::publishers::console

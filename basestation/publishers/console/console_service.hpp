// Console service of one car: messages to browsers and requests from them, between the service of
// the car and the web server.
//   in     messages and snapshots of the service; texts of consoles, from the server
//   out    messages to the server; requests to the service
//   invariants  the service computes ages, qualities, judgements, alarms and gates; consoles only
//          show them
//   cost   publish(): some tens of microseconds, a frame with all fields about 50
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "basestation/publishers/bench/bench_link.hpp"
#include "basestation/publishers/console/client_registry.hpp"
#include "basestation/publishers/console/pause_report.hpp"
#include "basestation/publishers/web/admission/token_store.hpp"
#include "basestation/publishers/web/web_server.hpp"
#include "basestation/service/publisher.hpp"

namespace pitwall::publishers::console {

struct ConsoleConfig {
  std::size_t place = 0;  // of this car among the cars of the server
  std::shared_ptr<web::TokenStore> tokens =
      std::make_shared<web::TokenStore>();  // identify the second person of an override
};

class ConsoleService : public service::Publisher, private StateSource {
 public:
  // Both outlive it.
  ConsoleService(ConsoleConfig config, service::CarService& car, web::WebServer& server);

  void packet(const service::CarService&, const telemetry::Arrival&) override {
    clients_.receive();
  }
  void submit(service::CarService& car, Instant now) override;
  void publish(const service::CarService& car, Instant now) override;
  Instant due() const override { return clients_.due(); }
  int fd() const override { return server_.fd(config_.place); }

  // Lets consoles show and start scenarios of this bench link, which must outlive the service.
  void attach(bench::BenchLink& bench);

  const ClientRegistry& clients() const { return clients_; }

 private:
  state::FieldView view(state::FieldId field, Instant now) const override;
  alarms::Evaluation evaluate(state::FieldId field, const state::FieldView& v) const override;
  std::vector<state::TrendPoint> past(state::FieldId field, Instant from, Instant to,
                                      std::size_t points) const override;
  const state::LapLog* laps() const override { return car_.laps(); }

  void execute(web::ClientId client, const Request& request, Instant now);
  Result<bool, Problem> ask_bench(const AskBench& ask, const command::Person& by, Instant now);
  void ask_page(std::uint64_t request, const std::string& page);
  command::Request with_second_person(const AskSend& ask) const;

  ConsoleConfig config_;
  service::CarService& car_;
  web::WebServer& server_;
  ClientRegistry clients_;
  PauseReport pauses_;
  bench::BenchLink* bench_ = nullptr;
  std::string catalogue_of_;  // CarIdentity::alarm_config of the limits in the catalogue
  state::LinkState link_shown_ = state::LinkState::kNone;
};

}  // namespace pitwall::publishers::console

// Client of a bench server: reconnects, forwards its messages to consoles and their starts and
// stops to it.
//   in     the path of the desk's socket; wishes of operators
//   out    texts for consoles, told through Ears; lines to the desk
//   invariants
//          nothing is started while the connected car says that it is real. A stop is carried in
//          any case: it only ends a simulation
//          a desk that is not there is looked for each kRetry, and consoles see that it is not
//          what the desk told within kTellEvery is told together, so a lockstep run that is a
//          hundred times faster than its car does not flood consoles
//   errors a line that is none: counted, shown, and the next one is read
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "basestation/publishers/bench/bench_book.hpp"
#include "basestation/service/publisher.hpp"
#include "protocol/transport/line_socket.hpp"
#include "protocol/vocabulary/result.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::publishers::bench {

struct BenchWish {
  bool start = false;  // else stop
  std::string scenario;
  std::optional<std::uint64_t> seed;
  bool live = false;
};

// One line of words for the audit log.
std::string text_of(const BenchWish& wish);

struct Ears {
  std::function<void(const Told&, Instant)> tell;
  // What the desk answered to whoever asked last.
  std::function<void(std::uint8_t client, const Problem&, Instant)> refused;
};

class BenchLink : public service::Publisher {
 public:
  static constexpr Duration kRetry = seconds(1), kTellEvery = milliseconds(200);
  static constexpr Duration kLook = milliseconds(50);

  explicit BenchLink(std::string path) : path_(std::move(path)) {}
  void tell_to(Ears ears) { ears_ = std::move(ears); }

  void publish(const service::CarService& car, Instant now) override;
  Instant due() const override { return looked_ + kLook; }

  // `client`: the console that asks, `by`: its operator.
  Result<bool, Problem> ask(const BenchWish& wish, std::uint8_t client, const std::string& by);
  bool up() const { return socket_ && !socket_->closed(); }
  const BenchBook& book() const { return book_; }

 private:
  void connect(Instant now);
  void hear(Instant now);
  std::string state_text() const;

  std::string path_;
  Ears ears_;
  BenchBook book_;
  std::optional<transport::LineSocket> socket_;
  std::optional<Instant> tried_, told_;
  Instant looked_{};
  std::uint64_t too_long_ = 0;
  std::uint8_t asker_ = 0;
  bool real_ = false;
  std::string problem_, state_told_;
};

}  // namespace pitwall::publishers::bench

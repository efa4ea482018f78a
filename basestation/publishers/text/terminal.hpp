// Terminal output of a base station: a screen of all cars, or, without a terminal, a line for each
// attack on the radio and each refused request.
//   invariants  a terminal that accepts no text (Ctrl-S, a full pipe) blocks the loop, which then
//          receives nothing from the car. This is accepted, because nobody watches such a screen
//          during a pause of bench time the screen is still refreshed, and shows the pause
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

#include "basestation/service/publisher.hpp"

namespace pitwall::publishers {

struct TerminalCar {
  service::CarService* service = nullptr;
  std::string title{};
};

class Screen : public service::LoopTask {
 public:
  struct Options {
    bool plain = false;  // no escape sequences, one screen after the other
    bool all = false;    // show every group
    Duration refresh = milliseconds(100);
  };
  Screen(std::vector<TerminalCar> cars, const Options& options, std::FILE* terminal)
      : cars_(std::move(cars)), options_(options), terminal_(terminal) {}

  void serve(Instant now) override;
  void finish(Instant now) override { show(now); }
  Instant due() const override { return next_; }

 private:
  bool is_pause_to_be_shown() const;
  void show(Instant now);

  std::vector<TerminalCar> cars_;
  Options options_;
  std::FILE* terminal_;
  Instant next_{};
  Duration shown_pause_{};  // length of the bench time pause on the newest screen
};

class StationLog : public service::LoopTask {
 public:
  StationLog(std::vector<TerminalCar> cars, std::FILE* terminal)
      : cars_(std::move(cars)), logged_(cars_.size()), terminal_(terminal) {}

  void serve(Instant now) override;
  void finish(Instant now) override { serve(now); }
  Instant due() const override { return Instant::max(); }

 private:
  struct Logged {
    std::uint64_t events = 0, audit = 0;
  };

  void log_threats(const link::Station& station, const std::string& title, Logged& logged);
  void log_refusals(const command::Audit& audit, const std::string& title, Logged& logged);

  std::vector<TerminalCar> cars_;
  std::vector<Logged> logged_;  // of each car
  std::FILE* terminal_;
};

}  // namespace pitwall::publishers

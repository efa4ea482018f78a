// SPDX-License-Identifier: Apache-2.0
#include "hil/sweep/local_engine.hpp"

#include <unistd.h>

#include <algorithm>
#include <deque>
#include <set>
#include <span>

#include "protocol/transport/clock.hpp"
#include "protocol/vocabulary/text.hpp"

namespace pitwall::sweep {
namespace {

constexpr std::size_t kShareMost = 20;  // cases of a process
constexpr Duration kPollPeriod = milliseconds(20);

std::deque<CaseNumbers> shares_of(const CaseNumbers& cases, unsigned processes) {
  const std::size_t share =
      std::clamp<std::size_t>(cases.size() / (std::size_t{processes} * 4), 1, kShareMost);
  std::deque<CaseNumbers> shares;
  for (std::size_t first = 0; first < cases.size(); first += share) {
    const auto part = std::span{cases}.subspan(first, std::min(share, cases.size() - first));
    shares.emplace_back(part.begin(), part.end());
  }
  return shares;
}

class Engine {
 public:
  Engine(const CaseNumbers& cases, std::size_t all, const SweepFolder& folder,
         const LocalEngine& engine)
      : all_(all), folder_(folder), engine_(engine), shares_(shares_of(cases, engine.processes)) {}

  Result<bool, Problem> run() {
    while (!shares_.empty() || !running_.empty()) {
      while (running_.size() < engine_.processes && !shares_.empty())
        if (const auto started = start(); !started) return started;
      if (const auto reaped = reap(); !reaped) return reaped;
      transport::sleep_until(transport::monotonic_now() + kPollPeriod);
    }
    return true;
  }

 private:
  struct Running {
    transport::Process process;
    CaseNumbers cases;
    std::string name;
  };

  Result<bool, Problem> start() {
    CaseNumbers cases = std::move(shares_.front());
    shares_.pop_front();
    // Of this engine, so that two in one folder do not write into one file.
    const std::string name = formatted("%d-%lld-%zu", static_cast<int>(::getpid()),
                                       static_cast<long long>((begun_ - Instant{}).ns), started_++);
    auto process = engine_.start(cases, name);
    if (!process) return Unexpected{process.error()};
    running_.push_back({*std::move(process), std::move(cases), name});
    return true;
  }

  Result<bool, Problem> reap() {
    for (std::size_t i = 0; i < running_.size();) {
      if (!running_[i].process.poll()) {
        ++i;
        continue;
      }
      const CaseNumbers cases = std::move(running_[i].cases);
      const std::string name = std::move(running_[i].name);
      running_.erase(running_.begin() + static_cast<std::ptrdiff_t>(i));
      if (const auto settled = settle(cases, name); !settled) return settled;
    }
    return true;
  }

  // The first case without a result is the one at which the process ended: again, alone.
  Result<bool, Problem> settle(const CaseNumbers& cases, const std::string& name) {
    const auto results = folder_.read_of(name, all_);
    if (!results) return Unexpected{results.error()};
    CaseNumbers left = without_result(cases, *results);
    if (!left.empty()) {
      const std::size_t ended_at = left.front();
      if (again_.insert(ended_at).second) {
        shares_.push_back({ended_at});
      } else {
        const auto written = folder_.append(
            "crashed", {.number = ended_at,
                        .verdict = CaseVerdict::kCrashed,
                        .why = "the process of the case ended without a result, twice"});
        if (!written) return written;
      }
      left.erase(left.begin());
      if (!left.empty()) shares_.push_back(left);
    }
    done_ += results->size();
    if (engine_.progress) engine_.progress(done_);
    return true;
  }

  std::size_t all_;
  const SweepFolder& folder_;
  const LocalEngine& engine_;
  std::deque<CaseNumbers> shares_;
  std::vector<Running> running_;
  std::set<std::size_t> again_;
  Instant begun_ = transport::monotonic_now();
  std::size_t started_ = 0, done_ = 0;
};

}  // namespace

Result<bool, Problem> run_here(const CaseNumbers& cases, std::size_t all, const SweepFolder& folder,
                               const LocalEngine& engine) {
  return Engine{cases, all, folder, engine}.run();
}

}  // namespace pitwall::sweep

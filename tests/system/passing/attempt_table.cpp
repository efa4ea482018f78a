// SPDX-License-Identifier: Apache-2.0
#include "tests/system/passing/attempt_table.hpp"

#include "protocol/vocabulary/random.hpp"
#include "protocol/vocabulary/text.hpp"

namespace pitwall::testing {
namespace {

constexpr std::uint64_t kMostSeed = 1'000'000'000;

// FNV-1a.
std::uint64_t hash_of(const std::string& text) {
  std::uint64_t hash = 0xCBF29CE484222325ULL;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001B3ULL;
  return hash;
}

}  // namespace

const char* text_of(Seeds seeds) {
  return seeds == Seeds::kCommitted ? "committed seeds" : "seeds of the commit";
}

AttemptCase case_of(Seeds seeds, const std::string& commit, std::size_t i, double round_mph,
                    Driver driver) {
  const std::uint64_t of = seeds == Seeds::kCommitted ? 0 : hash_of(commit);
  const auto mph = static_cast<std::uint64_t>(round_mph);
  const std::uint64_t seed = mix_bits(of + 1'000U * mph + i) % kMostSeed;
  return {.seed = seed, .round_mph = round_mph, .driver = driver};
}

AttemptCount count_of(const std::vector<AttemptRun>& runs, double round_mph, Driver driver) {
  AttemptCount count;
  for (const AttemptRun& run : runs) {
    if (run.of.round_mph != round_mph || run.of.driver != driver || !run.problem.empty()) continue;
    ++count.runs;
    ++count.by_verdict[static_cast<std::size_t>(run.verdict)];
    count.passes += run.passes, count.flaps += run.flaps;
    count.reversals += run.reversals, count.refusals += run.refusals;
  }
  return count;
}

std::vector<std::string> missed_gates(const std::vector<AttemptRun>& runs, Seeds seeds,
                                      std::span<const BracketGate> brackets) {
  std::vector<std::string> missed;
  for (const AttemptRun& run : runs)
    if (!run.problem.empty()) missed.push_back("a run was not made: " + run.problem);
  for (const BracketGate& gate : brackets) {
    const AttemptCount c = count_of(runs, gate.round_mph, Driver::kOurs);
    const std::size_t may_fail =
        gate.may_fail[static_cast<std::size_t>(seeds)] * c.runs / kGateAttempts;
    if (gate.is_gated && (c.runs == 0 || c.of(Verdict::kPassed) + may_fail < c.runs))
      missed.push_back(formatted("%.0f mph: %zu of %zu passed, expected %zu or more",
                                 gate.round_mph, c.of(Verdict::kPassed), c.runs,
                                 c.runs - may_fail));
    if (c.of(Verdict::kContact) > 0)
      missed.push_back(formatted("%.0f mph: %zu contacts, expected none", gate.round_mph,
                                 c.of(Verdict::kContact)));
    if (c.flaps > 0)
      missed.push_back(formatted("%.0f mph: %zu flaps, expected none", gate.round_mph, c.flaps));
    if (c.refusals > 0)
      missed.push_back(formatted("%.0f mph: %zu frames refused by the frame gate, expected none",
                                 gate.round_mph, c.refusals));
  }
  return missed;
}

std::string table_of(const std::vector<AttemptRun>& runs, Seeds seeds) {
  std::string text =
      formatted("%s\n%5s %-5s %8s %7s %9s %5s %8s %8s %6s %10s\n", text_of(seeds), "mph", "",
                "attempts", "passed", "declined", "lost", "contact", "begun", "flaps", "reversals");
  for (const BracketGate& gate : kBrackets)
    for (const Driver driver : kDrivers) {
      const AttemptCount c = count_of(runs, gate.round_mph, driver);
      if (c.runs == 0) continue;
      text +=
          formatted("%5.0f %-5s %8zu %7zu %9zu %5zu %8zu %8zu %6zu %10zu\n", gate.round_mph,
                    text_of(driver), c.runs, c.of(Verdict::kPassed), c.of(Verdict::kDeclined),
                    c.of(Verdict::kLost), c.of(Verdict::kContact), c.passes, c.flaps, c.reversals);
    }
  return text;
}

std::string row_of(const AttemptRun& run) {
  if (!run.problem.empty()) return run.problem;
  return formatted(
      "%3.0f mph seed %9llu %-5s %-8s %-18s %.2f laps, %zu passes begun, %zu flaps, "
      "%zu reversals",
      run.of.round_mph, static_cast<unsigned long long>(run.of.seed), text_of(run.of.driver),
      text_of(run.verdict), run.ending.c_str(), run.laps, run.passes, run.flaps, run.reversals);
}

}  // namespace pitwall::testing

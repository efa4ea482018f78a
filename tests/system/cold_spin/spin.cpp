// The paper's spin with both chains: `./pitwall long spin`.
// Exit: 0 the gates hold, 1 one does not, 2 the command line is wrong.
// SPDX-License-Identifier: Apache-2.0
#include <CLI/CLI.hpp>
#include <cstdint>
#include <cstdio>
#include <vector>

#include "protocol/transport/file.hpp"
#include "tests/system/cold_spin/cold_spin.hpp"

int main(int argc, char** argv) {
  using namespace pitwall;
  using namespace pitwall::testing;
  std::size_t count = 100;
  double base_mph = 0.0;
  unsigned processes = 2;
  std::string json_file;
  bool by_seed = false;
  CLI::App app{"20 mph more into a turn on cold tyres: the published chain and ours, in lockstep."};
  app.add_option("--seeds", count, "how many")->check(CLI::Range(1, 10'000));
  app.add_option("--base", base_mph, "another base speed, mph: to see what the figure depends on")
      ->check(CLI::Range(60.0, 180.0));
  app.add_flag("--by-seed", by_seed, "the base speed by the loss of each seed, not by the mean");
  app.add_option("--processes", processes, "at once")->check(CLI::Range(1, 256));
  app.add_option("--json", json_file, "write the figures here");
  CLI11_PARSE(app, argc, argv);
  std::vector<SpinCase> cases;
  for (std::uint64_t seed = 1; seed <= count; ++seed)
    for (const Chain chain : kChains)
      cases.push_back({seed, chain,
                       by_seed          ? base_speed_mph(drawn_loss(seed))
                       : base_mph > 0.0 ? base_mph
                                        : base_speed_mph()});
  std::printf("simulated: tyres at %.0f C, loss of grip %.2f to %.2f, %.0f mph more at the turn\n",
              kSpinTyre_c, kLossLeast, kLossMost, kSpinRaise_mph);
  const std::vector<SpinRun> runs = run_spins(cases, processes);
  for (const SpinRun& run : runs) std::printf("%s\n", row_of(run).c_str());
  for (const Chain chain : kChains) {
    const SpinCount c = count_of(runs, chain);
    std::printf("%-5s %3zu runs, %3zu came to the turn, %3zu spin, %3zu at the wall\n",
                text_of(chain), c.runs, c.raised, c.spun, c.left);
  }
  if (!json_file.empty() && !transport::write_file(json_file, to_json(runs)))
    return std::fprintf(stderr, "--json: cannot write %s\n", json_file.c_str()), 2;
  const std::string fault = fault_of(runs);
  if (!fault.empty()) std::printf("%s\n", fault.c_str());
  return fault.empty() ? 0 : 1;
}

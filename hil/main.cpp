// pitwall-hil: the bench. One verb per job.
// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cstdio>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "hil/can_bus/bus_verb.hpp"
#include "hil/cli/dbc/dbc_verb.hpp"
#include "hil/cli/demo/demo_verb.hpp"
#include "hil/cli/exit_code.hpp"
#include "hil/cli/faults_verb.hpp"
#include "hil/cli/kitti/track_kitti_verb.hpp"
#include "hil/cli/recordings/compare_verb.hpp"
#include "hil/cli/recordings/convert_verb.hpp"
#include "hil/cli/recordings/info_verb.hpp"
#include "hil/cli/recordings/plot_verb.hpp"
#include "hil/cli/recordings/rival_verb.hpp"
#include "hil/cli/report_verb.hpp"
#include "hil/cli/run_verb.hpp"
#include "hil/cli/scenario/scenario_verb.hpp"
#include "hil/cli/scenes_verb.hpp"
#include "hil/cli/serve_verb.hpp"
#include "hil/cli/sweep/falsify_verb.hpp"
#include "hil/cli/sweep/sweep_verb.hpp"
#include "hil/cli/track_verb.hpp"
#include "hil/replay/replay_verb.hpp"

namespace pitwall {
namespace {

struct Verb {
  std::string_view name, help;
  int (*run)(std::span<const std::string> args);
};

constexpr std::array kVerbs{
    Verb{"run", "run SCENARIO in lockstep or live (--live)", cli::run_verb},
    Verb{"sweep", "many cases of a scenario, with other values in it (PLAN)", cli::sweep_verb},
    Verb{"falsify", "values at which a scenario misses an expectation (PLAN)", cli::falsify_verb},
    Verb{"demo", "the whole system: car, bench and base station on real SocketCAN", cli::demo_verb},
    Verb{"serve", "starts scenarios for who asks at a socket, and tells how they go",
         cli::serve_verb},
    Verb{"report", "the page of a run (HTML, JUnit) from its event log", cli::report_verb},
    Verb{"replay", "replay a CAN log onto CAN interfaces", replay::replay_verb},
    Verb{"compare", "a car's recording driven again by this build: what it says otherwise",
         cli::compare_verb},
    Verb{"scenario", "scenario files: new, check, list; from a car's recording (from)",
         cli::scenario_verb},
    Verb{"rival", "where the other car of a race was, by the recordings of both cars",
         cli::rival_verb},
    Verb{"info", "what a log or a recording holds: span, sources, identifiers, rates",
         cli::info_verb},
    Verb{"convert", "CAN frames in another format: candump, ASC, BLF, TRC, pcap, pcapng",
         cli::convert_verb},
    Verb{"plot", "signals of a CAN log over time, as SVG or HTML", cli::plot_verb},
    Verb{"dbc", "CAN databases: check, show, diff", cli::dbc_verb},
    Verb{"bus", "CAN interfaces: from this kernel or from a guest", can_bus::bus_verb},
    Verb{"faults", "every fault of the catalogue: who notices it, how fast, and the outcome",
         cli::faults_verb},
    Verb{"track", "tracks: check, import from a CSV, picture", cli::track_verb},
    Verb{"scenes", "drawn scenes for the training of the networks", cli::scenes_verb},
    Verb{"track-kitti", "the tracker of other cars on a sequence of KITTI", cli::track_kitti_verb},
};

int usage(std::FILE* out, int code) {
  std::fprintf(out, "pitwall-hil VERB [ARG...]   (VERB --help for its options)\n\n");
  for (const Verb& verb : kVerbs)
    std::fprintf(out, "  %-11s %s\n", verb.name.data(), verb.help.data());
  std::fprintf(
      out, "\nexit codes: 0 pass, 1 an expectation or gate failed, 2 bad input or bench failure\n");
  return code;
}

}  // namespace
}  // namespace pitwall

int main(int argc, char** argv) {
  using namespace pitwall;  // NOLINT: the whole program
  const std::vector<std::string> words(argv + 1, argv + argc);
  if (words.empty()) return usage(stderr, cli::kExitUnusable);
  if (words[0] == "--help" || words[0] == "help") return usage(stdout, cli::kExitPass);
  for (const Verb& verb : kVerbs)
    if (words[0] == verb.name) return verb.run(std::span(words).subspan(1));
  std::fprintf(stderr, "pitwall-hil: error: unknown verb \"%s\"\n", words[0].c_str());
  return usage(stderr, cli::kExitUnusable);
}

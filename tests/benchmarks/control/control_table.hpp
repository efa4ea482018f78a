// Table, JSON and gates of the control benchmark: a row per track, world and control law.
//   gates  they decide the exit code; each is printed with the figure that is worst for it
//          held       every law holds every speed of the nominal world for a minute
//          half       above 40 m/s, on every track: our mean error is at most half of that of
//                     `paper_lqr` in the same world, or 0.05 m, whichever is larger
//          nominal    means and maxima in the nominal world are at most the goals
//          other      so are the means in the worst other world, if one was driven; a drawn car is
//                     printed alone
//   units  m, m/s
//   source the goals: chosen before the first run, from the figures of the paper's season one
//          (Saba et al.), a tenth to a third of them
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>
#include <vector>

#include "tests/benchmarks/control/control_run.hpp"

namespace pitwall::control_bench {

inline constexpr const char* kPaper = "paper_lqr";
inline constexpr const char* kOurs = "lqr_ff";
inline constexpr const char* kOfStops = "feed_forward";  // beside them, not judged

// By the brackets of grading::kBrackets.
struct Goal {
  double nominal_mean_m, perturbed_mean_m, max_m;
};
inline constexpr std::array<Goal, grading::kBrackets.size()> kGoals{{{0.15, 0.28, 0.50},
                                                                     {0.12, 0.28, 0.50},
                                                                     {0.10, 0.18, 0.35},
                                                                     {0.09, 0.18, 0.35},
                                                                     {0.08, 0.18, 0.35},
                                                                     {0.07, 0.12, 0.25},
                                                                     {0.06, 0.12, 0.25},
                                                                     {0.05, 0.12, 0.25},
                                                                     {0.04, 0.06, 0.15},
                                                                     {0.03, 0.06, 0.15}}};

struct Gate {
  std::string name, worst;  // the worst figure, with its place
  bool held = true;
};

std::vector<Gate> gates_of(const std::vector<ControlRow>& rows);
bool all_held(const std::vector<Gate>& gates);

std::string to_text(const std::vector<ControlRow>& rows);
std::string to_text(const std::vector<Gate>& gates);
std::string to_json(const std::vector<ControlRow>& rows);  // an array, as is the next
std::string to_json(const std::vector<Gate>& gates);

}  // namespace pitwall::control_bench

// SPDX-License-Identifier: Apache-2.0
#include "hil/report/contact_section.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

#include "hil/report/page.hpp"
#include "tests/hil/report/some_run.hpp"

namespace pitwall::report {
namespace {

struct PathExtent {
  double x0 = kUnset, x1 = kUnset, y0 = kUnset, y1 = kUnset;
  std::size_t pieces = 0;
};

// Of the lines of this width, in pixels.
std::vector<PathExtent> outlines_in(const std::string& html, const std::string& width) {
  std::vector<PathExtent> out;
  const std::string opening = "<path class=\"mark\"";
  for (std::size_t at = html.find(opening); at != std::string::npos;
       at = html.find(opening, at + 1)) {
    const std::string path = html.substr(at, html.find("/>", at) - at);
    if (path.find("stroke-width=\"" + width + "\"") == std::string::npos) continue;
    PathExtent& e = out.emplace_back();
    for (std::size_t i = path.find(" d=\"") + 4; i < path.size(); ++i) {
      if (path[i] != 'M' && path[i] != 'L') continue;
      if (path[i] == 'M') ++e.pieces;
      char* end = nullptr;
      const double x = std::strtod(&path[i + 1], &end), y = std::strtod(end, nullptr);
      e = {std::fmin(e.x0, x), std::fmax(e.x1, x), std::fmin(e.y0, y), std::fmax(e.y1, y),
           e.pieces};
    }
  }
  return out;
}

TEST(ContactSection, SaysWhoWhereHowFastAndByWhichRule) {
  const std::string html = contact_section(run_of({.with_contact = true}));
  for (const char* fact :
       {"<dt>caused by</dt><dd>this car</dd>",
        "<dt>decided by</dt><dd>rule 1: a car that stood causes nothing</dd>",
        "<dt>with</dt><dd>&lt;b&gt;slow&lt;/b&gt; (number 6)</dd>", "with a standing car",
        "<dt>when</dt><dd>10.00 s</dd>", "<dt>station</dt><dd>110 m</dd>",
        "<dt>offset of this car, left positive</dt><dd>-0.50 m</dd>",
        "<dt>offset of the other</dt><dd>0.25 m</dd>",
        "<dt>speed of this car</dt><dd>31.0 m/s</dd>",
        "<dt>speed of the other</dt><dd>0.0 m/s</dd>", "<dt>closing</dt><dd>31.0 m/s</dd>"})
    EXPECT_EQ(count(html, fact), 1u) << fact << " in " << html.substr(0, 1500);
}

TEST(ContactSection, WhoCausedItIsOneTheOtherBothOrNeither) {
  RunData run = run_of({.with_contact = true});
  run.contact->is_caused_by_other = true;
  EXPECT_EQ(count(contact_section(run), "<dt>caused by</dt><dd>both cars</dd>"), 1u);
  run.contact->is_caused = false;
  EXPECT_EQ(count(contact_section(run), "<dt>caused by</dt><dd>&lt;b&gt;slow"), 1u);
  run.contact->is_caused_by_other = false;
  EXPECT_EQ(count(contact_section(run), "<dt>caused by</dt><dd>neither</dd>"), 1u);
}

// 4.9 m long, both, and nose to tail.
TEST(ContactSection, ThePictureHasBothCarsInOneScale) {
  const std::string html = contact_section(run_of({.with_contact = true}));
  EXPECT_EQ(count(html, "data-plot=\"contact\""), 1u);
  EXPECT_EQ(count(html, ">!</text>"), 1u) << "where they touched";
  const auto last = outlines_in(html, "3");
  ASSERT_EQ(last.size(), 2u);
  for (const PathExtent& car : last)
    EXPECT_NEAR((car.x1 - car.x0) / (car.y1 - car.y0), 4.9 / 1.9, 0.03) << "one scale";
  EXPECT_NEAR(last[0].x1, last[1].x0, 0.2) << "nose to tail";
  const double pixels_per_m = (last[0].x1 - last[0].x0) / 4.9;
  const auto before = outlines_in(html, "1");
  ASSERT_EQ(before.size(), 2u);
  EXPECT_EQ(before[0].pieces, 5u);
  EXPECT_EQ(before[1].pieces, 5u);
  EXPECT_NEAR(before[1].x0, last[1].x0, 0.2) << "it stood";
  // On its circle: the chord of a second is 31 m long, and turned by half the angle.
  const bench::TruthSample from = truth_at(9.0, {}), to = truth_at(10.0, {});
  EXPECT_NEAR(std::hypot(from.x_m - to.x_m, from.y_m - to.y_m),
              2.0 * 100.0 * std::sin(0.5 * 31.0 / 100.0), 1e-9);
  const double moved_px = std::max(before[0].x1 - last[0].x1, last[0].x0 - before[0].x0);
  EXPECT_NEAR(moved_px / pixels_per_m, std::abs(from.x_m - to.x_m), 0.05);
}

TEST(ContactSection, WithoutPlacesThereIsNoPictureAndWithoutAContactNothing) {
  RunData run = run_of({.with_contact = true});
  run.contact->other.x_m = kUnset;
  EXPECT_EQ(count(contact_section(run), "data-absent=\"contact\""), 1u);
  EXPECT_EQ(contact_section(run_of({})), "");
  EXPECT_EQ(count(page(run_of({}), nullptr, "none"), "Contact with another car"), 0u);
  EXPECT_EQ(
      count(page(run_of({.with_contact = true}), nullptr, "none"), "Contact with another car"), 1u);
}

// The event is a sentence, as one of a contact with a wall is.
TEST(ContactSection, TheTableOfEventsHasTheSentence) {
  const RunData run = run_of({.with_contact = true});
  ASSERT_EQ(run.events.back().v.name, "contact");
  EXPECT_EQ(run.events.back().v.text, bench::to_text(some_contact({.with_contact = true})));
}

}  // namespace
}  // namespace pitwall::report

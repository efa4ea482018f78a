"""Makes reports of a run that passes, one that fails, and one as a live run leaves it, and opens
them (opened_page.py says how it is used).
"""
# SPDX-License-Identifier: Apache-2.0
import os
import pathlib
import re

from event_log import as_live, truth_speeds
from opened_page import PageTest, main

SCENARIO = "tests/system/report/short_fault.yaml"
ALWAYS = {"states", "speed", "cross_track", "wall_gap", "pedals", "steering", "bus_load", "tyres",
          "map", "brackets", "station", "gg"}


class ReportPage(PageTest):
    def reported(self, name, scenario=SCENARIO):
        folder = self.in_folder(name)
        code, said = self.hil("run", scenario, "--report", folder)
        for file in ("events.mcap", "run.json", "report.html", "junit.xml"):
            self.assertTrue(os.path.exists(os.path.join(folder, file)), said)
        return code, folder

    def test_a_run_with_a_fault(self):
        code, folder = self.reported("passed")
        self.assertEqual(code, 0)
        found = self.opened(os.path.join(folder, "report.html"))
        self.assert_drawn(found, ALWAYS)
        self.assertNotIn("target_speed", found["absent"])
        self.assertIn("PASS", self.text_of("#verdict"))
        self.read_out(os.path.join(folder, "events.mcap"))

    def read_out(self, log):
        """The value under the pointer is that of the log."""
        place = self.browser.evaluate(
            "(() => { const s = document.querySelector('svg[data-plot=speed]');"
            " s.scrollIntoView(); const b = s.getBoundingClientRect();"
            " return [b.left + b.width * 0.4, b.top + b.height * 0.5]; })()")
        self.browser.move_pointer(*place)
        said = self.browser.evaluate(
            "document.querySelector('svg[data-plot=speed] .read').textContent")
        match = re.search(r"([\d.]+) s .*speed ([\d.]+) m/s", said)
        self.assertTrue(match, said)
        t_s, speed_mps = map(float, match.groups())
        true_mps = min(truth_speeds(log), key=lambda row: abs(row[0] - t_s))[1]
        self.assertAlmostEqual(speed_mps, true_mps, delta=0.5)
        everywhere = self.browser.evaluate(
            "[...document.querySelectorAll('svg.time .read')].filter(r => r.textContent).length")
        self.assertEqual(everywhere, 8, "every plot over time reads out together")
        self.browser.move_pointer(1, 1)
        self.assertEqual(self.browser.evaluate(
            "document.querySelector('svg[data-plot=speed] .read').textContent"), "")

    def test_a_run_that_fails(self):
        text = pathlib.Path(SCENARIO).read_text()
        spoilt = text.replace("value: 200", "value: 20")
        self.assertNotEqual(spoilt, text)
        with open(self.in_folder("failing.yaml"), "w") as file:
            file.write(spoilt)
        code, folder = self.reported("failed", self.in_folder("failing.yaml"))
        self.assertEqual(code, 1)
        found = self.opened(os.path.join(folder, "report.html"))
        self.assert_drawn(found, ALWAYS)
        self.assertIn("FAIL", self.text_of("#verdict"))
        self.assertEqual(
            self.browser.evaluate("document.querySelectorAll('tr.broken').length"), 1)

    def test_a_live_run_without_the_cars_own_view(self):
        _, folder = self.reported("source")
        page = self.in_folder("live.html")
        as_live(os.path.join(folder, "events.mcap"), self.in_folder("live.mcap"))
        code, said = self.hil("report", self.in_folder("live.mcap"), "--out", page)
        self.assertEqual(code, 0, said)
        found = self.opened(page)
        self.assert_drawn(found, ALWAYS)
        self.assertIn("target_speed", found["absent"])
        self.assertIn("wake", found["absent"])

    def test_a_log_that_is_cut(self):
        _, folder = self.reported("whole")
        log = pathlib.Path(folder, "events.mcap").read_bytes()
        with open(self.in_folder("cut.mcap"), "wb") as file:
            file.write(log[:len(log) // 2])
        page = self.in_folder("cut.html")
        code, _ = self.hil("report", self.in_folder("cut.mcap"), "--out", page)
        self.assertEqual(code, 2)
        self.opened(page)
        self.assertIn("INFRASTRUCTURE", self.text_of("#verdict"))

    def test_no_log_at_all(self):
        page = self.in_folder("none.html")
        code, _ = self.hil("report", self.in_folder("none.mcap"), "--out", page)
        self.assertEqual(code, 2)
        found = self.opened(page)
        self.assertIn("map", found["absent"])


if __name__ == "__main__":
    main()

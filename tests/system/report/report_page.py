"""Makes reports of a run that passes, one that fails, and one as a live run leaves it, and opens
them as a person does: headless Chromium at 1280 x 800.

  usage  report_page.py PITWALL_HIL [FOLDER]     FOLDER keeps the pages and their pictures
"""
# SPDX-License-Identifier: Apache-2.0
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

from chromium import Chromium
from event_log import as_live, truth_speeds

SCENARIO = "tests/system/report/short_fault.yaml"
WIDTH, HEIGHT = 1280, 800
ALWAYS = {"states", "speed", "cross_track", "wall_gap", "pedals", "steering", "bus_load", "tyres",
          "map", "brackets", "station", "gg"}
CHECKS = pathlib.Path(__file__).with_name("page_checks.js").read_text()
PROGRAM, FOLDER = "", ""


def hil(*words):
    done = subprocess.run([PROGRAM, *words], capture_output=True, text=True, timeout=120)
    return done.returncode, done.stdout + done.stderr


def in_folder(*names):
    return os.path.join(FOLDER, *names)


class ReportPage(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.browser = Chromium(in_folder("profile"), WIDTH, HEIGHT)

    @classmethod
    def tearDownClass(cls):
        cls.browser.__exit__()

    def opened(self, path):
        """What the checks say of a page; its complaints are failures of this test."""
        self.assertLess(os.path.getsize(path), 2_000_000)
        self.browser.open(path)
        found = self.browser.evaluate(CHECKS)
        self.assertEqual(found["complaints"], [])
        self.assertEqual(self.browser.complaints(), [])
        outside = [url for url in self.browser.requests()
                   if not url.startswith(("file://" + path, "data:"))]
        self.assertEqual(outside, [])
        self.browser.screenshot(path.replace(".html", ".png"), whole_page=False)
        self.browser.screenshot(path.replace(".html", "_whole.png"), whole_page=True)
        return found

    def assert_drawn(self, found, names):
        self.assertLessEqual(names, set(found["plots"]))
        for name, marks in found["plots"].items():
            self.assertGreater(marks, 0, name)

    def reported(self, name, scenario=SCENARIO):
        folder = in_folder(name)
        code, said = hil("run", scenario, "--report", folder)
        for file in ("events.mcap", "run.json", "report.html", "junit.xml"):
            self.assertTrue(os.path.exists(os.path.join(folder, file)), said)
        return code, folder

    def test_a_run_with_a_fault(self):
        code, folder = self.reported("passed")
        self.assertEqual(code, 0)
        found = self.opened(os.path.join(folder, "report.html"))
        self.assert_drawn(found, ALWAYS)
        self.assertNotIn("target_speed", found["absent"])
        self.assertIn("PASS", self.browser.evaluate("document.getElementById('verdict').innerText"))
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
        with open(in_folder("failing.yaml"), "w") as file:
            file.write(spoilt)
        code, folder = self.reported("failed", in_folder("failing.yaml"))
        self.assertEqual(code, 1)
        found = self.opened(os.path.join(folder, "report.html"))
        self.assert_drawn(found, ALWAYS)
        self.assertIn("FAIL", self.browser.evaluate("document.getElementById('verdict').innerText"))
        self.assertEqual(
            self.browser.evaluate("document.querySelectorAll('tr.broken').length"), 1)

    def test_a_live_run_without_the_cars_own_view(self):
        _, folder = self.reported("source")
        page = in_folder("live.html")
        as_live(os.path.join(folder, "events.mcap"), in_folder("live.mcap"))
        code, said = hil("report", in_folder("live.mcap"), "--out", page)
        self.assertEqual(code, 0, said)
        found = self.opened(page)
        self.assert_drawn(found, ALWAYS)
        self.assertIn("target_speed", found["absent"])
        self.assertIn("wake", found["absent"])

    def test_a_log_that_is_cut(self):
        _, folder = self.reported("whole")
        log = pathlib.Path(folder, "events.mcap").read_bytes()
        with open(in_folder("cut.mcap"), "wb") as file:
            file.write(log[:len(log) // 2])
        code, _ = hil("report", in_folder("cut.mcap"), "--out", in_folder("cut.html"))
        self.assertEqual(code, 2)
        self.opened(in_folder("cut.html"))
        self.assertIn("INFRASTRUCTURE",
                      self.browser.evaluate("document.getElementById('verdict').innerText"))

    def test_no_log_at_all(self):
        code, _ = hil("report", in_folder("none.mcap"), "--out", in_folder("none.html"))
        self.assertEqual(code, 2)
        found = self.opened(in_folder("none.html"))
        self.assertIn("map", found["absent"])


if __name__ == "__main__":
    PROGRAM = os.path.abspath(sys.argv[1])
    with tempfile.TemporaryDirectory(prefix="pitwall-report-") as temporary:
        FOLDER = os.path.abspath(sys.argv[2]) if len(sys.argv) > 2 else temporary
        os.makedirs(FOLDER, exist_ok=True)
        unittest.main(argv=sys.argv[:1], verbosity=2)

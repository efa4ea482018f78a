"""Pages of the bench, opened as a person does: headless Chromium at 1280 x 800.

  usage  TEST.py PITWALL_HIL [FOLDER]     FOLDER keeps the pages and their pictures
"""
# SPDX-License-Identifier: Apache-2.0
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

from chromium import Chromium

WIDTH, HEIGHT = 1280, 800
CHECKS = pathlib.Path(__file__).with_name("page_checks.js").read_text()


class PageTest(unittest.TestCase):
    program, folder = "", ""

    @classmethod
    def setUpClass(cls):
        cls.browser = Chromium(cls.in_folder("profile"), WIDTH, HEIGHT)

    @classmethod
    def tearDownClass(cls):
        cls.browser.__exit__()

    @classmethod
    def in_folder(cls, *names):
        return os.path.join(cls.folder, *names)

    @classmethod
    def hil(cls, *words):
        done = subprocess.run([cls.program, *words], capture_output=True, text=True, timeout=180)
        return done.returncode, done.stdout + done.stderr

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

    def text_of(self, selector):
        return self.browser.evaluate(f"document.querySelector({selector!r}).innerText")

    def assert_drawn(self, found, names):
        self.assertLessEqual(names, set(found["plots"]))
        for name, marks in found["plots"].items():
            self.assertGreater(marks, 0, name)


def main():
    PageTest.program = os.path.abspath(sys.argv[1])
    with tempfile.TemporaryDirectory(prefix="pitwall-report-") as temporary:
        PageTest.folder = os.path.abspath(sys.argv[2]) if len(sys.argv) > 2 else temporary
        os.makedirs(PageTest.folder, exist_ok=True)
        unittest.main(module="__main__", argv=sys.argv[:1], verbosity=2)

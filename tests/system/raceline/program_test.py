#!/usr/bin/env python3
"""The program that makes racelines: program_test.py PROGRAM TREE

Makes the bank of each track that ships, integrates every line anew from its curvature alone, and
lets the program check its own banks, and refuse what is not theirs.
"""
# SPDX-License-Identifier: Apache-2.0
import json
import math
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree as ElementTree
from pathlib import Path

PROGRAM, TREE = sys.argv[1], Path(sys.argv[2])
CAR = TREE / "vehicle/config/cars/av21.yaml"
TRACKS = TREE / "vehicle/config/tracks"
NAMES = ["inner/inside", "inner/centre", "inner/outside", "inner/apex", "outer/inside",
         "outer/centre", "outer/outside", "outer/apex", "track/minimum_curvature", "pit/centre"]
# A row of curvature at 1 m, integrated with its mean in between, is off by h^2/12 of its change.
POSITION_OFF_M = 0.05


def raceline(track, *arguments, car=CAR):
    return subprocess.run([PROGRAM, TRACKS / track if isinstance(track, str) else track, "--car",
                           car, *arguments], capture_output=True, text=True, timeout=60)


class ProgramTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def make(self, track, *arguments):
        bank = self.folder / "bank.json"
        done = raceline(track, "--out", bank, *arguments)
        self.assertEqual(done.returncode, 0, done.stderr)
        return bank

    def refuse(self, done, *parts):
        self.assertEqual(done.returncode, 2, done.stdout)
        for part in parts:
            self.assertIn(part, done.stderr)

    def test_every_line_follows_from_its_curvature(self):
        for track in ("lvms.yaml", "ims.yaml", "tms.yaml"):
            bank = json.loads(self.make(track).read_text())
            self.assertEqual([line["name"] for line in bank["lines"]], NAMES)
            for line in bank["lines"]:
                self.follow(line, f"{track} {line['name']}")

    def follow(self, line, name):
        points = line["points"]
        step = line["length_m"] / len(points)
        self.assertLessEqual(step, 1.0, name)
        x, y, yaw, *_ = points[0]
        start, turned = yaw, 0.0
        for i, here in enumerate(points):
            after = points[(i + 1) % len(points)]
            turn = step * 0.5 * (here[3] + after[3])
            x += step * math.cos(yaw + 0.5 * turn)
            y += step * math.sin(yaw + 0.5 * turn)
            yaw += turn
            turned += turn
            self.assertLess(math.hypot(x - after[0], y - after[1]), POSITION_OFF_M, f"{name} {i}")
        self.assertAlmostEqual(turned, 2.0 * math.pi, places=4, msg=name)
        self.assertAlmostEqual(yaw - start, 2.0 * math.pi, places=4, msg=name)

    def test_picture_and_report_are_written(self):
        picture, report = self.folder / "bank.svg", self.folder / "report.json"
        self.make("lvms.yaml", "--picture", picture, "--report", report)
        self.assertTrue(ElementTree.parse(picture).getroot().tag.endswith("svg"))
        lines = json.loads(report.read_text())["lines"]
        self.assertEqual([line["name"] for line in lines], NAMES)
        for line in lines:
            self.assertGreater(line["room_least_m"]["value"], 0.0, line["name"])

    def test_it_takes_its_own_bank(self):
        bank = self.make("ims.yaml")
        done = raceline("ims.yaml", "--check", bank)
        self.assertEqual(done.returncode, 0, done.stderr)
        for name in NAMES:
            self.assertIn(f"\n{name} ", done.stdout)

    def test_a_bank_of_another_track_or_revision_is_refused(self):
        bank = self.make("ims.yaml")
        self.refuse(raceline("tms.yaml", "--check", bank), "bank.json: error: is of track IMS")
        revised = self.folder / "ims.yaml"
        text = (TRACKS / "ims.yaml").read_text()
        revised.write_text(text.replace("bank_deg: 9.2", "bank_deg: 9.3", 1))
        self.refuse(raceline(revised, "--check", bank), "is of another revision of track IMS")
        revised.write_text(text + "# A remark is no revision.\n")
        self.assertEqual(raceline(revised, "--check", bank).returncode, 0)

    def test_a_damaged_line_is_refused_with_its_place_and_value(self):
        bank = self.make("lvms.yaml")
        content = json.loads(bank.read_text())
        content["lines"][3]["points"][500][3] += 0.002
        bank.write_text(json.dumps(content))
        self.refuse(raceline("lvms.yaml", "--check", bank), "inner/apex: s = 49",
                    "the curvature jumps: the points turn with 0.00")

    def test_a_wider_car_leaves_its_lane(self):
        bank = self.make("lvms.yaml", "--clearance", "0.3")
        wide = self.folder / "wide.yaml"
        wide.write_text(CAR.read_text().replace("width_m: 1.93", "width_m: 2.8", 1))
        self.refuse(raceline("lvms.yaml", "--check", bank, car=wide),
                    "inner/inside: s = ", "leaves the inner lane: the side of the car is 0.")

    def test_chosen_apexes_move_the_line(self):
        found = json.loads(self.make("lvms.yaml").read_text())
        apexes = self.folder / "apexes.yaml"
        apexes.write_text("outer:\n  - {s_m: 700, n_m: -5.5}\n  - {s_m: 1850, n_m: -5.5}\n")
        chosen = json.loads(self.make("lvms.yaml", "--apexes", apexes).read_text())
        for before, after in zip(found["lines"], chosen["lines"]):
            self.assertEqual(before == after, before["name"] != "outer/apex", before["name"])
        apexes.write_text("outer:\n  - {s_m: 700, n_m: -50}\n")
        self.refuse(raceline("lvms.yaml", "--out", self.folder / "no.json", "--apexes", apexes),
                    "apexes.yaml:2:")
        self.assertFalse((self.folder / "no.json").exists())

    def test_wrong_usage_is_refused(self):
        bank = self.make("lvms.yaml")
        self.refuse(raceline("lvms.yaml", "--check", bank, "--out", self.folder / "b.json"))
        self.refuse(raceline("lvms.yaml", "--clearance", "-1"))
        self.refuse(raceline(self.folder / "none.yaml"), "none.yaml")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])

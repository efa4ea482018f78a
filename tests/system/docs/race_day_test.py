#!/usr/bin/env python3
"""Runs the commands of docs/race_day.md, one after the other: race_day_test.py TREE BUILD

Each runs as it stands, in a folder that looks like a checkout. The first makes the recording, in
bench time; of the comparisons the last finds a car that was changed, and only that one.
"""
# SPDX-License-Identifier: Apache-2.0
import re
import subprocess
import sys
import tempfile
from pathlib import Path

TREE, BUILD = Path(sys.argv[1]), Path(sys.argv[2])
PATIENCE_S = 200
DIFFERS = "stiffer.yaml"  # in the command whose car is another one


def expect(condition, what):
    if not condition:
        sys.exit(f"FAILED: {what}")


def commands():
    page = (TREE / "docs/race_day.md").read_text()
    return re.findall(r"(?m)^    (.*)$", page)


def main():
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for entry in TREE.iterdir():
            if entry.name not in ("build", "out"):
                (folder / entry.name).symlink_to(entry)
        (folder / "build").mkdir()
        (folder / "build/release").symlink_to(BUILD)
        (folder / "out").mkdir()
        said = {}
        for line in commands():
            here = line.replace("/tmp/pitwall-race-bus", f"{name}/bus")
            ran = subprocess.run(["bash", "-c", here], cwd=folder, text=True, timeout=PATIENCE_S,
                                 stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)
            print(f"$ {line}\n{ran.stdout}")
            differs = "compare" in line and DIFFERS in line
            expect(ran.returncode == (1 if differs else 0), f"{line}: code {ran.returncode}")
            said[line] = ran.stdout
        compared = [text for line, text in said.items() if " compare " in line]
        expect(len(compared) == 5, "five comparisons")
        same = compared[:2] + compared[3:]
        expect(all(": 0 signals differ" in text for text in same), "nothing differs")
        expect("command.throttle: " in compared[2], "the changed gain is found in the throttle")
        live = [text for line, text in said.items() if " --live " in line and " compare " in line]
        expect(len(live) == 2 and all(re.search(r", [3-9] modes and \d{4} commands compared", text)
                                      for text in live), "modes and commands are compared live")
        shown = [text for line, text in said.items() if " info " in line]
        expect("/can/in" in shown[0] and "/gnss/1" in shown[0], "the recording's sources")
        expect("/can/in" in shown[1], "the log's channel")
        played = [text for line, text in said.items() if " replay " in line]
        expect(re.search(r"sent \d{4,} frames and \d{4,} datagrams .* 0 dropped", played[0]),
               "frames and datagrams are played, and none is dropped")


if __name__ == "__main__":
    main()

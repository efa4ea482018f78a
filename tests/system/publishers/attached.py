"""A real base, a car's end of its radio, and programs that attach to them, as processes of a test:
the test's arguments are BASE CAR TREE."""
# SPDX-License-Identifier: Apache-2.0
import atexit
import os
import re
import signal
import subprocess
import sys
import time
import urllib.request
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[2] / "support"))
import test_clock  # noqa: E402

BASE, CAR, TREE = sys.argv[1], sys.argv[2], Path(sys.argv[3])
ORACLES = TREE / "tests/support/oracles"
LCM_GROUP, LCM_PORT = "239.255.76.67", 7667
RUN_S = 40  # the car's, longer than what attaches

STARTED = []


@atexit.register
def end_all():
    for process in STARTED:
        process.kill()


def start(words, **pipes):
    STARTED.append(subprocess.Popen(words, **{"stdout": subprocess.DEVNULL, **pipes}))
    return STARTED[-1]


def expect(condition, what):
    if not condition:
        sys.exit(f"FAILED: {what}")


class Base:
    """A pitwall-base, with the addresses that it says; those of `wanted` are waited for."""

    NAMES = {"radio": r"listening at ([\d.:]+)", "web": r"console at (http://[\d.:]+)",
             "foxglove": r"Foxglove at (ws://[\d.:]+)"}

    def __init__(self, *flags, names=None, wanted=("foxglove", "web")):
        self.process = start([BASE, *test_clock.FLAGS, *flags], stderr=subprocess.PIPE, text=True)
        self.said, self.at = "", {}
        while not self.at.keys() >= set(wanted):
            line = self.process.stderr.readline()
            expect(line, f"the addresses are said: {self.said}")
            self.said += line
            for name, pattern in (names or self.NAMES).items():
                if found := re.search(pattern, self.said):
                    self.at[name] = found.group(1)

    def metrics(self):
        with urllib.request.urlopen(self.at["web"] + "/metrics", timeout=10) as answer:
            expect(answer.headers["Content-Type"].startswith("text/plain; version=0.0.4"), "type")
            return answer.read().decode()

    def end(self):
        self.process.send_signal(signal.SIGTERM)
        _, errors = self.process.communicate(timeout=30)
        expect(self.process.returncode == 0, f"exit code {self.process.returncode}: {errors}")


def value(metrics, metric, /, **labels):
    """Of the only sample with these labels; None: there is none."""
    for line in metrics.splitlines():
        found = re.fullmatch(rf"{metric}(?:{{(.*)}})? (\S+)", line)
        if not found:
            continue
        told = dict(re.findall(r'(\w+)="((?:[^"\\]|\\.)*)"', found.group(1) or ""))
        if labels.items() <= told.items():
            return float(found.group(2))
    return None


def foxglove(mode, address, *more):
    node = ORACLES / "node_modules/.bin/node"
    expect(node.exists(), "the npm packages of the tests are installed (./pitwall setup)")
    done = subprocess.run([node, ORACLES / "foxglove_client.mjs", mode, address, *more],
                          capture_output=True, text=True, timeout=90)
    expect(done.returncode == 0, f"Foxglove's client, {mode}: {done.stdout}{done.stderr}")
    return done.stdout.strip()


def until(what, find, patience_s=15):
    end = time.monotonic() + patience_s
    while time.monotonic() < end:
        if found := find():
            return found
        time.sleep(0.1)
    return expect(False, f"waited in vain for {what}")


def keys_in(folder):
    """Makes a base's and a car's, and gives their paths."""
    subprocess.run([BASE, "keygen", "--out", str(folder)], check=True, capture_output=True)
    return str(folder / "base.keys"), str(folder / "car.keys")


def start_car(keys, radio, speed_mps=50.5):
    return start([CAR, keys, radio, str(RUN_S)],
                 env={**os.environ, "PITWALL_CAR_SPEED_MPS": str(speed_mps)})


def start_lcm_logger(log):
    url = f"--lcm-url=udpm://{LCM_GROUP}:{LCM_PORT}?ttl=0"
    return start(["lcm-logger", "--quiet", url, str(log)])

#!/usr/bin/env python3
"""The real pitwall-base process, fed over loopback: loopback.py BASE SENDER"""
# SPDX-License-Identifier: Apache-2.0
import json
import re
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

BASE, SENDER = sys.argv[1:3]
COUNT = 101  # the last is no multiple of ten, so that every gap shows


def expect(condition, what):
    if not condition:
        sys.exit(f"FAILED: {what}")


def start(*flags):
    process = subprocess.Popen([BASE, "--listen", "127.0.0.1:0", *flags],
                               stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    said = process.stderr.readline()
    match = re.search(r"127\.0\.0\.1:(\d+)", said)
    expect(match, f"the address is said, not: {said}")
    return process, match.group(1)


def hears_the_car_and_stops_on(stop_signal, folder):
    summary = folder / f"{stop_signal.name}.json"
    process, port = start("--text", "--plain", "--refresh", "20", "--json", str(summary))
    subprocess.run([SENDER, f"127.0.0.1:{port}", str(COUNT)], check=True)
    time.sleep(0.2)
    process.send_signal(stop_signal)
    screens, _ = process.communicate(timeout=30)
    expect(process.returncode == 0, f"{stop_signal.name}: exit code {process.returncode}")

    heard = json.loads(summary.read_text())
    gaps, twice = COUNT // 10, sum(1 for i in range(1, COUNT + 1) if i % 7 == 0 and i % 10)
    for key, value in {"source": "simulation", "packets": COUNT - gaps, "lost": gaps,
                       "duplicates": twice, "refused": 3, "late": 0, "other_run": 0}.items():
        expect(heard[key] == value, f"{key} is {heard[key]}, not {value}")
    expect(heard["refused_by_kind"]["damaged"] == 3, "damaged ones are counted as such")
    expect(heard["fields"]["ego.vx"]["value"] == 50.5, "the last value is shown")
    expect(heard["fields"]["ego.vx"]["age_ms"] >= 3, "with the age that it was sent with")
    expect(heard["fields"]["ego.x"]["value"] is None, "what was never sent is null")
    ages = heard["age_ms"]
    expect(3 <= ages["p50"] <= ages["p90"] <= ages["p99"] <= ages["max"], f"ages {ages}")
    expect(heard["rate_hz"] > 0, "a rate")
    expect("waiting for the first packet" in screens, "the first screen waits")
    expect("*** SIMULATION ***" in screens, "a simulation is shown as one")
    expect("50.50 m/s" in screens, "the last screen shows the last value")
    expect("\x1b" not in screens, "plain is plain")


def ends_by_itself(folder):
    summary = folder / "silent.json"
    process, _ = start("--duration", "0.3", "--json", str(summary))
    out, _ = process.communicate(timeout=30)
    expect(process.returncode == 0 and out == "", "no text unless asked for")
    heard = json.loads(summary.read_text())
    expect(heard["packets"] == 0 and heard["source"] == "none", "silence is reported as silence")


def refuses_mistakes(folder):
    for flags in (["--nonsense"], ["--listen", "here"], ["--listen", "127.0.0.1:70000"],
                  ["--listen"], ["--listen", "0.0.0.0:0"], ["--duration", "x"],
                  ["--duration", "-1"], ["--duration", "nan"], ["--refresh", "0"],
                  ["--refresh", "nan"], ["--text", "something"]):
        done = subprocess.run([BASE, *flags], capture_output=True, text=True, timeout=30)
        expect(done.returncode == 2 and done.stderr, f"{flags}: exit code {done.returncode}")
    done = subprocess.run([BASE, "--help"], capture_output=True, text=True, timeout=30)
    expect(done.returncode == 0 and "--listen" in done.stdout, "help is no mistake")
    done = subprocess.run([BASE, "--listen", "0.0.0.0:0", "--network", "--duration", "0.1"],
                          capture_output=True, text=True, timeout=30)
    expect(done.returncode == 0, "--network allows other machines")
    process, port = start()
    taken = subprocess.run([BASE, "--listen", f"127.0.0.1:{port}"], capture_output=True,
                           text=True, timeout=30)
    expect(taken.returncode == 1 and port in taken.stderr, "a taken port is named")
    process.terminate()
    process.communicate(timeout=30)
    nowhere = str(folder / "no" / "folder.json")
    done = subprocess.run([BASE, "--listen", "127.0.0.1:0", "--duration", "0.1", "--json", nowhere],
                          capture_output=True, text=True, timeout=30)
    expect(done.returncode == 1 and nowhere in done.stderr, "a summary that cannot be written")


with tempfile.TemporaryDirectory(prefix="pitwall_base_") as name:
    hears_the_car_and_stops_on(signal.SIGINT, Path(name))
    hears_the_car_and_stops_on(signal.SIGTERM, Path(name))
    ends_by_itself(Path(name))
    refuses_mistakes(Path(name))
print("ok")

#!/usr/bin/env python3
"""The real pitwall-base process and a car's end of the radio: loopback.py BASE CAR"""
# SPDX-License-Identifier: Apache-2.0
import json
import os
import re
import signal
import socket
import stat
import subprocess
import sys
import tempfile
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[2] / "support"))
import test_clock  # noqa: E402

BASE, CAR = sys.argv[1:3]


def expect(condition, what):
    if not condition:
        sys.exit(f"FAILED: {what}")


def start(folder, *flags, radios=1):
    listen = ["--listen", "127.0.0.1:0"] * radios
    process = subprocess.Popen([BASE, "--keys", str(folder / "keys/base.keys"), *listen, *flags,
                                *test_clock.FLAGS],
                               stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    said = process.stderr.readline()
    ports = re.findall(r"127\.0\.0\.1:(\d+)", said)
    expect(len(ports) == radios, f"the addresses are said, not: {said}")
    return process, [f"127.0.0.1:{port}" for port in ports]


def drive(folder, addresses, length_s):
    words = [CAR, str(folder / "keys/car.keys"), addresses[0], str(length_s), *addresses[1:]]
    return subprocess.run(words, check=True, capture_output=True, text=True, timeout=60).stdout


def finish(process, stop_signal=signal.SIGTERM):
    process.send_signal(stop_signal)
    screens, errors = process.communicate(timeout=30)
    expect(process.returncode == 0, f"{stop_signal.name}: exit code {process.returncode} {errors}")
    return screens, errors


def keys_are_made_once_and_for_their_owner_only(folder):
    keygen = [BASE, "keygen", "--out", str(folder / "keys")]
    made = subprocess.run(keygen, check=True, capture_output=True, text=True)
    for name in ("car.keys", "base.keys"):
        path = folder / "keys" / name
        expect(stat.S_IMODE(path.stat().st_mode) == 0o600, f"{name} is for its owner only")
        secret = re.search(r"^secret: (\w+)$", path.read_text(), re.M).group(1)
        expect(secret not in made.stdout + made.stderr, "no secret is printed")
    again = subprocess.run(keygen, capture_output=True, text=True)
    expect(again.returncode == 1 and "exists already" in again.stderr, "keys are not replaced")


def hears_the_car_and_stops_on(stop_signal, folder):
    summary = folder / f"{stop_signal.name}.json"
    process, addresses = start(folder, "--text", "--all", "--plain", "--refresh", "20", "--json",
                               str(summary))
    drive(folder, addresses, 2.0)
    screens, _ = finish(process, stop_signal)
    heard = json.loads(summary.read_text())
    for key, value in {"source": "simulation", "refused": 0, "sessions": 1,
                       "requests_refused": 0}.items():
        expect(heard[key] == value, f"{key} is {heard[key]}, not {value}")
    expect(heard["packets"] >= 40, f"about 100 packets, not {heard['packets']}")
    expect(heard["fields"]["ego.vx"]["value"] == 50.5, "the last value is shown")
    expect(heard["fields"]["ego.vx"]["age_ms"] > 0, "with its age")
    expect(heard["fields"]["ego.y"]["value"] is None, "what was never known is null")
    expect(heard["clock"]["known"], "the clocks are compared")
    ages = heard["ages_ms"]["safety"]
    expect(0 < ages["p50"] <= ages["p90"] <= ages["p99"] <= ages["max"], f"ages {ages}")
    expect([e["event"] for e in heard["events"]] == ["the car is here"], "events come once")
    expect("waiting for the first packet" in screens, "the first screen waits")
    expect("*** SIMULATION ***" in screens, "a simulation is shown as one")
    expect("vx: 50.50 m/s" in screens, "the last screen shows the last value")
    expect("\x1b" not in screens, "plain is plain")


def what_the_operator_says_is_done(folder):
    script = folder / "words.txt"
    script.write_text("# what an operator does\n0.3 take 1\n0.5 command speed_limit 30\n"
                      "0.8 stop emergency\n1.2 take 1\n1.3 release because it stands\n")
    summary = folder / "operator.json"
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    commands = folder / "commands"
    process, addresses = start(folder, "--command", str(script), "--stop-port", str(port),
                               "--command-socket", str(commands), "--json", str(summary))
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as words:
        words.sendto(b"command speed_limit 90\n", ("127.0.0.1", port))
    expect(stat.S_IMODE(commands.stat().st_mode) == 0o600, "the command socket is its owner's")
    with socket.socket(socket.AF_UNIX, socket.SOCK_STREAM) as client:
        client.settimeout(30)
        client.connect(str(commands))
        client.sendall(b"command speed_limit 90\nack all\n")
        lines = client.makefile()
        answers = lines.readline(), lines.readline()
    expect(answers[0].startswith("refused: gate ") and answers[1] == "done\n",
           f"each line has its answer: {answers}")
    said = drive(folder, addresses, 2.5)
    _, errors = finish(process)
    expect(said.splitlines() == ["command speed limit 30", "stop 2", "stop 0", "sessions 1"],
           f"the car was told otherwise: {said}")
    heard = json.loads(summary.read_text())
    fates = [(c["command"], c["fate"]) for c in heard["commands"]]
    expect(fates[0] == ("speed limit 30 m/s", "applied"), f"commands {fates}")
    expect(len(fates) == 2 and fates[1][1] == "applied", f"the release {fates}")
    expect(heard["requests_refused"] == 2, f"what was refused is counted: {heard}")
    expect("stop port: command speed_limit 90: refused: only stops" in errors and
           "command socket: send speed limit 90 m/s: refused: gate " in errors,
           f"and logged: {errors}")


def restarts_are_over_after_one_exchange(folder):
    process, addresses = start(folder)
    port = addresses[0]
    car = subprocess.Popen([CAR, str(folder / "keys/car.keys"), port, "3"],
                           stdout=subprocess.PIPE, text=True)
    time.sleep(1.0)
    process.kill()
    process.communicate()
    summary = folder / "restarted.json"
    again = subprocess.Popen([BASE, "--keys", str(folder / "keys/base.keys"), "--listen", port,
                              "--json", str(summary), *test_clock.FLAGS],
                             stderr=subprocess.PIPE, text=True)
    again.stderr.readline()
    said, _ = car.communicate(timeout=30)
    finish(again)
    expect("sessions 2" in said, f"the car met the new base: {said}")
    heard = json.loads(summary.read_text())
    expect(heard["packets"] >= 40, f"and it heard the car: {heard['packets']} packets")


def two_radios_are_one_link(folder):
    summary = folder / "two.json"
    process, addresses = start(folder, "--json", str(summary), radios=2)
    drive(folder, addresses, 1.5)
    finish(process)
    heard = json.loads(summary.read_text())
    expect(len(heard["paths"]) == 2, "two paths")
    for path in heard["paths"]:
        expect(path["received"] > 20 and path["up_packets"] > 20, f"both ways: {path}")
        expect(path["address_proved"], f"where the car is, is proved: {path}")
    expect(heard["refused"] == 0 and heard["duplicates"] > 20, "copies are no refusals")


def mistakes_are_named_before_anything_begins(folder):
    bad = folder / "bad.txt"
    bad.write_text("1 fly\n")
    keys = ["--keys", str(folder / "keys/base.keys")]
    for flags, what in (([], "keygen --out"),
                        (["--keys", str(folder / "keys/car.keys")], "the car's keys"),
                        ([*keys, "--listen", "0.0.0.0:0"], "--network"),
                        ([*keys, *["--listen", "127.0.0.1:0"] * 3], "at most two"),
                        ([*keys, "--listen", "nowhere"], "--listen"),
                        ([*keys, "--command", str(bad)], "bad.txt:1"),
                        ([*keys, "--command", str(folder / "none")], "none"),
                        ([*keys, "--budget", "1"], "--budget"),
                        ([*keys, "--duration", "nan"], "--duration")):
        done = subprocess.run([BASE, "--duration", "5", *flags], capture_output=True, text=True,
                              timeout=20)
        expect(done.returncode == 2 and what in done.stderr, f"{flags}: {done.stderr}")
    os.chmod(folder / "keys/base.keys", 0o644)
    done = subprocess.run([BASE, *keys], capture_output=True, text=True, timeout=20)
    expect(done.returncode == 2, "keys that others can read are refused")
    os.chmod(folder / "keys/base.keys", 0o600)


def ends_by_itself(folder):
    summary = folder / "silent.json"
    process, _ = start(folder, "--duration", "0.3", "--json", str(summary))
    process.communicate(timeout=20)
    expect(process.returncode == 0, "a silent run ends well")
    heard = json.loads(summary.read_text())
    expect(heard["car"] == "not received yet" and heard["packets"] == 0, "and says so")


with tempfile.TemporaryDirectory() as temporary:
    FOLDER = Path(temporary)
    keys_are_made_once_and_for_their_owner_only(FOLDER)
    hears_the_car_and_stops_on(signal.SIGINT, FOLDER)
    hears_the_car_and_stops_on(signal.SIGTERM, FOLDER)
    what_the_operator_says_is_done(FOLDER)
    restarts_are_over_after_one_exchange(FOLDER)
    two_radios_are_one_link(FOLDER)
    mistakes_are_named_before_anything_begins(FOLDER)
    ends_by_itself(FOLDER)
print("pitwall-base: all held")

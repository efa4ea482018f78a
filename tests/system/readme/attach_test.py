#!/usr/bin/env python3
"""Runs the lines of the README's "Attach your tools": attach_test.py BASE CAR TREE BUILD

Each line is run as it stands, in a folder with keys of the bench, beside a car that speaks; a line
that starts a base goes on while the others run. `sudo ./pitwall install base` installs into a tree
of the test's own. Then the tool of each paragraph is asked what it saw.
"""
# SPDX-License-Identifier: Apache-2.0
import os
import re
import signal
import subprocess
import sys
import tempfile
from pathlib import Path

BASE, CAR, TREE, BUILD = sys.argv[1], sys.argv[2], Path(sys.argv[3]), sys.argv[4]
sys.path.insert(0, str(TREE / "tests/system/recorder"))
import lcm_oracle  # noqa: E402

ORACLES = TREE / "tests/support/oracles"
INSTALLER = "basestation/settings/install/install_station.sh"  # what the launcher calls
LINES_AT_MOST = 3
CAR_S, PATIENCE_S, LOGGER_S = 120, 60, 3


def expect(condition, what):
    if not condition:
        sys.exit(f"FAILED: {what}")


def paragraphs():
    """The tools of the README with their lines."""
    text = (TREE / "README.md").read_text()
    section = re.search(r"\n## Attach your tools\n(.*?)(?=\n## )", text, re.S)
    expect(section, "the README has a section Attach your tools")
    tools = {}
    for name, rest in re.findall(r"\n\*\*(.+?)\*\*(.*?)(?=\n\*\*|\Z)", section[1], re.S):
        tools[name] = re.findall(r"(?m)^    (\S.*?)(?:\s+#.*)?$", rest)
    return tools


class Bench:
    """A folder with keys, a car that speaks, and what runs beside it."""

    def __init__(self, folder):
        self.folder, self.background = folder, []
        (folder / "bin").mkdir()
        (folder / "bin/pitwall-base").symlink_to(BASE)
        (folder / "root").mkdir()
        self.environment = {**os.environ, "HOME": str(folder),
                            "PATH": f"{folder / 'bin'}:{os.environ['PATH']}"}
        subprocess.run([BASE, "keygen", "--out", folder / "keys"], check=True, capture_output=True)
        for keys in ("car.keys", "base.keys"):
            with (folder / "keys" / keys).open("a") as file:
                file.write("use: bench\n")

    def start_car(self):
        self.background.append(subprocess.Popen(
            [CAR, self.folder / "keys/car.keys", "127.0.0.1:23431", str(CAR_S)],
            stdout=subprocess.DEVNULL))

    def start(self, line):
        process = subprocess.Popen(["exec " + line], shell=True, cwd=self.folder, text=True,
                                   env=self.environment, stdout=subprocess.DEVNULL,
                                   stderr=subprocess.PIPE)
        self.background.append(process)
        said = ""
        while "listening at" not in said:
            more = process.stderr.readline()
            expect(more, f"{line}: {said}")
            said += more

    def run(self, line):
        if line.startswith("sudo ./pitwall install base"):
            line = f"{TREE}/{INSTALLER} base --root root --build {BUILD}"
        if line.startswith("lcm-logger"):
            line = f"timeout --preserve-status --signal INT {LOGGER_S} {line}"
        done = subprocess.run(["bash", "-o", "pipefail", "-c", line], cwd=self.folder, text=True,
                              capture_output=True, env=self.environment, timeout=PATIENCE_S)
        expect(done.returncode == 0, f"{line}: exit {done.returncode}: {done.stdout}{done.stderr}")
        return done.stdout

    def stop(self):
        for process in self.background:
            process.send_signal(signal.SIGKILL)
            process.communicate()
        self.background = []


def ros_2(bench, _):
    # Another maker's participant, which comes now, makes ours tell its topics; a third looks on.
    looking = subprocess.Popen(
        ["tshark", "-i", "lo", "-a", "duration:8", "-Y", "rtps.param.topicName", "-T", "fields",
         "-e", "rtps.param.topicName", "-e", "rtps.param.typeName"], text=True,
        stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    while "Capturing on" not in looking.stderr.readline():
        expect(looking.poll() is None, "tshark captures")
    for _ in range(2):  # it says so some time before it does so
        subprocess.run(["timeout", "3", "ddsperf", "sub"], stdout=subprocess.DEVNULL)
    topics, _ = looking.communicate()
    expect("rt/vehicle/odom" in topics and "nav_msgs::msg::dds_::Odometry_" in topics, topics)
    expect((bench.folder / "pitwall_msgs/package.xml").exists(), "a package for colcon")


def foxglove(_bench, _):
    client = subprocess.run([ORACLES / "node_modules/.bin/node", ORACLES / "foxglove_client.mjs",
                             "live", "ws://127.0.0.1:8765"], capture_output=True, text=True)
    expect(client.returncode == 0, client.stdout + client.stderr)


def lcm(bench, _):
    expect((bench.folder / "pitwall").is_dir(), "lcm-gen made the types")
    channels = {channel for _, channel, _ in lcm_oracle.events_of(bench.folder / "race.log")}
    expect("/car/ego" in channels, f"channels {channels}")


def prometheus(bench, _):
    told = (bench.folder / "metrics.txt").read_text()
    expect("\npitwall_car_info{" in told, "metrics of the car")


def wireshark(bench, said):
    expect(list((bench.folder / "root").rglob("wireshark/plugins/pitwall.lua")), "the dissector")
    expect("opened by the key log" in said[-1] and "vx" in said[-1], said[-1][:2_000])


TOOLS = {"ROS 2": ros_2, "Foxglove": foxglove, "LCM": lcm, "Prometheus": prometheus,
         "Wireshark": wireshark}


def main():
    tools = paragraphs()
    expect(set(tools) == set(TOOLS), f"tools of the README: {set(tools)}")
    for name, lines in tools.items():
        expect(0 < len(lines) <= LINES_AT_MOST, f"{name} has {len(lines)} lines")
        with tempfile.TemporaryDirectory(prefix="pitwall_attach_") as folder:
            bench = Bench(Path(folder))
            try:
                said = []
                for line in lines:
                    if line.startswith("pitwall-base --keys"):
                        bench.start(line)
                        bench.start_car()
                    else:
                        said.append(bench.run(line))
                    plugin = next((bench.folder / "root").rglob("pitwall.lua"), None)
                    if plugin and not (bench.folder / ".local").exists():
                        home = bench.folder / ".local/lib/wireshark/plugins"
                        home.mkdir(parents=True)
                        (home / "pitwall.lua").symlink_to(plugin)
                TOOLS[name](bench, said)
            finally:
                bench.stop()
        print(f"{name}: {len(lines)} lines run")


main()

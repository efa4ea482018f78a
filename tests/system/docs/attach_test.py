#!/usr/bin/env python3
"""Runs the commands of docs/attaching_tools.md: attach_test.py TREE BUILD

Each line runs as it stands, in a folder that looks like a checkout. A line that starts a base or a
car goes on while the others run, and each tool has both anew. Two commands are the test's own:
`sudo` asks nobody, and `./pitwall install base` installs into a tree of the test's own, whose
programs are then on the path. Then the tool of each paragraph is asked what it saw.
"""
# SPDX-License-Identifier: Apache-2.0
import os
import re
import signal
import subprocess
import sys
import tempfile
from pathlib import Path

TREE, BUILD = Path(sys.argv[1]), Path(sys.argv[2])
sys.path.insert(0, str(TREE / "tests/system/recorder"))
import lcm_oracle  # noqa: E402

ORACLES = TREE / "tests/support/oracles"
INSTALLER = TREE / "basestation/settings/install/install_station.sh"  # what the launcher calls
GOES_ON = re.compile(r"pitwall-base --keys|build/release/hil/pitwall-hil run")
LINES_AT_MOST = 3
PATIENCE_S, LOGGER_S, END_S = 60, 3, 10


def expect(condition, what):
    if not condition:
        sys.exit(f"FAILED: {what}")


def lines_of(text):
    """The lines of code, as they stand; one that goes on in the next is one."""
    code = "\n".join(re.findall(r"(?m)^    (.*)$", text))
    return re.split(r"(?<!\\)\n", code) if code else []


def tools_of_the_page():
    """The lines before the first tool, and the tools with theirs."""
    text = (TREE / "docs/attaching_tools.md").read_text()
    first, *rest = re.split(r"\n\*\*(.+?)\*\*", text)
    tools = {name: lines_of(paragraph) for name, paragraph in zip(rest[::2], rest[1::2])}
    return lines_of(first), tools


def write_program(path, text):
    path.write_text(f"#!/bin/sh\n{text}\n")
    path.chmod(0o755)


class Checkout:
    """A folder that looks like a checkout with a build, and what runs in it."""

    def __init__(self, folder):
        self.folder, self.root, self.running = folder, folder / "machine", []
        for entry in TREE.iterdir():
            if entry.name not in ("build", "out", "pitwall"):
                (folder / entry.name).symlink_to(entry)
        (folder / "build").mkdir()
        (folder / "build/release").symlink_to(BUILD)
        for name in ("machine", "bin"):
            (folder / name).mkdir()
        write_program(folder / "bin/sudo", 'exec "$@"')
        write_program(folder / "pitwall",
                      f'[ "$*" = "install base" ] || exit 2\n'
                      f'exec "{INSTALLER}" base --root "{self.root}" --build "{BUILD}"')
        installed = self.root / "opt/pitwall/bin"  # a link in /usr/local/bin leads there
        self.environment = {**os.environ, "HOME": str(folder),
                            "PATH": f"{installed}:{folder / 'bin'}:{os.environ['PATH']}"}
        plugins = folder / ".local/lib/wireshark/plugins"
        plugins.mkdir(parents=True)
        self.plugin = plugins / "pitwall.lua"

    def start(self, line):
        said = self.folder / f"said{len(self.running)}.txt"
        with said.open("w") as file:
            process = subprocess.Popen(["bash", "-c", "exec " + line], cwd=self.folder, stdout=file,
                                       stderr=subprocess.STDOUT, env=self.environment,
                                       start_new_session=True)
        self.running.append((process, line, said))
        if line.startswith("pitwall-base"):
            while "listening at" not in said.read_text():
                expect(process.poll() is None, f"{line}: {said.read_text()}")

    def run(self, line):
        if line.startswith("lcm-logger"):  # who logs ends it by hand
            # --foreground: otherwise the signal comes twice, once through the group, and the second
            # may find the pipe to which the logger tells the first one closed.
            line = f"timeout --foreground --preserve-status --signal INT {LOGGER_S} {line}"
        done = subprocess.run(["bash", "-o", "pipefail", "-c", line], cwd=self.folder, text=True,
                              capture_output=True, env=self.environment, timeout=PATIENCE_S)
        expect(done.returncode == 0, f"{line}: exit {done.returncode}: {done.stdout}{done.stderr}")
        return done.stdout

    def install(self, lines):
        """What is done once."""
        for line in lines:
            self.run(line)
        link = self.root / "usr/local/bin/pitwall-base"
        expect(os.readlink(link) == "/opt/pitwall/bin/pitwall-base", "the base is on the path")
        self.plugin.symlink_to(next(self.root.rglob("wireshark/plugins/pitwall.lua")))

    def check_running(self):
        for process, line, said in self.running:
            expect(process.poll() is None, f"{line}: ended: {said.read_text()}")

    def stop(self):
        for process, _, _ in self.running:
            process.send_signal(signal.SIGTERM)
        for process, _, _ in self.running:
            try:
                process.wait(END_S)
            except subprocess.TimeoutExpired:
                os.killpg(process.pid, signal.SIGKILL)
        self.running = []


def ros_2(checkout, _):
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
    expect((checkout.folder / "pitwall_msgs/package.xml").exists(), "a package for colcon")


def foxglove(_checkout, _):
    client = subprocess.run([ORACLES / "node_modules/.bin/node", ORACLES / "foxglove_client.mjs",
                             "bench", "ws://127.0.0.1:8765"], capture_output=True, text=True)
    expect(client.returncode == 0, client.stdout + client.stderr)


def lcm(checkout, _):
    expect(list(checkout.folder.glob("types/pitwall/*.py")), "lcm-gen made the types")
    channels = {channel for _, channel, _ in lcm_oracle.events_of(checkout.folder / "race.log")}
    expect("/car/ego" in channels, f"channels {channels}")


def prometheus(checkout, _):
    told = (checkout.folder / "metrics.txt").read_text()
    expect("\npitwall_car_info{" in told, "metrics of the car")


def wireshark(_checkout, said):
    # A field of safety is in every packet; those of motion only while they change.
    opened = said[-1].count("opened by the key log")
    fields = said[-1].count("sys_state")
    expect(opened > 100 and fields > 100, f"{opened} packets opened: {said[-1][:2_000]}")


TOOLS = {"ROS 2": ros_2, "Foxglove": foxglove, "LCM": lcm, "Prometheus": prometheus,
         "Wireshark": wireshark}


def attach(checkout, name, cars, lines):
    try:
        said = []
        for line in cars + lines:
            if GOES_ON.match(line):
                checkout.start(line)
            else:
                said.append(checkout.run(line))
        TOOLS[name](checkout, said)
        checkout.check_running()
    finally:
        checkout.stop()
    print(f"{name}: {len(lines)} lines run", flush=True)


def main():
    first, tools = tools_of_the_page()
    expect(set(tools) == set(TOOLS), f"tools of the page: {set(tools)}")
    cars = [line for line in first if GOES_ON.match(line)]
    expect(len(cars) == 1, f"one line starts a car: {first}")
    with tempfile.TemporaryDirectory(prefix="pitwall_attach_") as folder:
        checkout = Checkout(Path(folder))
        checkout.install([line for line in first if line not in cars])
        for name, lines in tools.items():
            expect(0 < len(lines) <= LINES_AT_MOST, f"{name} has {len(lines)} lines")
            attach(checkout, name, cars, lines)


main()

#!/usr/bin/env python3
"""Two cars on one base, apart in every tool: two_cars.py BASE CAR TREE"""
# SPDX-License-Identifier: Apache-2.0
import signal
import subprocess
import sys
import tempfile
from pathlib import Path

from attached import (BASE, TREE, Base, expect, foxglove, keys_in, start_car, start_lcm_logger,
                      until, value)

sys.path.insert(0, str(TREE / "tests/system/recorder"))
import lcm_oracle  # noqa: E402

SPEEDS = {7: 50.5, 8: 61.25}


def base_of_two(folder):
    keys, rows = {}, "cars:\n"
    for number in SPEEDS:
        _, keys[number] = keys_in(folder / f"keys{number}")
        rows += f"  - {{number: {number}, keys: keys{number}/base.keys, listen: ['127.0.0.1:0']}}\n"
    (folder / "cars.yaml").write_text(rows)
    names = {"web": Base.NAMES["web"]}
    for number in SPEEDS:
        names[f"radio{number}"] = rf"CAR {number} .*" + Base.NAMES["radio"]
        names[f"foxglove{number}"] = rf"car {number}: " + Base.NAMES["foxglove"]
    base = Base("--cars", str(folder / "cars.yaml"), "--web", "0", "--foxglove", "0", "--lcm",
                "--track", "lvms", names=names, wanted=names)
    return base, keys


def speeds_of(base):
    metrics = base.metrics()
    return {number: value(metrics, "pitwall_field_meters_per_second", car=str(number),
                          group="ego", field="vx") for number in SPEEDS}


def metrics_are_apart(base):
    found = until("both cars in the metrics", lambda: (
        lambda speeds: speeds if None not in speeds.values() else None)(speeds_of(base)))
    for number, speed in found.items():
        expect(abs(speed - SPEEDS[number]) < 0.1, f"metrics: car {number} at {speed}")


def one_is_gone(base):
    """And nobody takes the other for it."""
    until("the silence of car 8", lambda: speeds_of(base)[8] is None)
    expect(abs(speeds_of(base)[7] - SPEEDS[7]) < 0.1, "car 7 is as before")
    until("its age", lambda: value(base.metrics(), "pitwall_group_age_seconds", car="8",
                                   group="ego") > 1)
    age = value(base.metrics(), "pitwall_group_age_seconds", car="7", group="ego")
    expect(age < 1, f"car 7 is fresh, not {age} s old")


def channels_are_apart(log, folder):
    types, count = lcm_oracle.types_of(BASE, folder), dict.fromkeys(SPEEDS, 0)
    for _, channel, data in lcm_oracle.events_of(log):
        _, space, rest = channel.split("/", 2)
        number = int(space.removeprefix("car"))
        expect(number in SPEEDS, f"a channel of neither car: {channel}")
        if rest == "car/ego":
            speed = types.ego_t.decode(data).vx
            expect(abs(speed - SPEEDS[number]) < 0.1, f"{channel}: {speed}")
            count[number] += 1
    expect(min(count.values()) > 20, f"both are told: {count}")
    return count


def main():
    folder = Path(tempfile.mkdtemp(prefix="pitwall_two_tools_"))
    log = folder / "lcm.log"
    logger = start_lcm_logger(log)
    base, keys = base_of_two(folder)
    cars = {number: start_car(keys[number], base.at[f"radio{number}"], speed)
            for number, speed in SPEEDS.items()}
    metrics_are_apart(base)
    for number, speed in SPEEDS.items():
        foxglove("space", base.at[f"foxglove{number}"], f"/car{number}", str(speed))
    cars[8].kill()
    cars[8].wait()
    one_is_gone(base)
    foxglove("space", base.at["foxglove7"], "/car7", str(SPEEDS[7]))
    base.end()
    logger.send_signal(signal.SIGTERM)
    logger.wait(timeout=20)
    count = channels_are_apart(log, folder)
    subprocess.run(["rm", "-r", str(folder)], check=True)
    print(f"apart in metrics, Foxglove and LCM: {count}")


main()

#!/usr/bin/env python3
"""Laps and history of a replay against NumPy: laps_test.py BASE [RECORDING]

Without a recording one is written here: a drive of six laps of LVMS whose way over time is known in
closed form, with a silence inside a lap and one over the line.

Against NumPy over the same samples, by another way than the base's: the stations are unwrapped as a
whole and interpolated at once. Both are linear between samples, so that they differ by rounding:
  a lap time by that of doubles, 1e-6 s; a point's time by that of a float below 64 s, 1e-5 s
  a speed by a float's and by 15 m/s^2 over the point's 1e-5 s: 2e-4 m/s
Against the truth of the drive: a station is rounded to 0.1 m, which at 40 m/s or more is 1.25 ms;
the way between two samples of 0.06 s is no straight line by a T^2 / 8 = 1.2 mm, 0.03 ms. A lap
time has two such ends, a difference of two laps at a station four: 2.6 ms and 5.2 ms.
"""
# SPDX-License-Identifier: Apache-2.0
import re
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

import recorded_drive
from console_client import ConsoleClient
from recorded_drive import Recording

LAP_S, POINT_S, SPEED_MPS = 1e-6, 1e-5, 2e-4
TRUE_LAP_S, TRUE_DELTA_S = 2.6e-3, 5.2e-3
GAP_S = 0.5
LAPS, LVMS_M = 6, 2454.3
BEFORE_LINE_M = 300.0
SILENCES_S = (4.0, 3.0)  # inside the third lap, and over the line at the end of the fourth


def expect(condition, what):
    if not condition:
        sys.exit(f"FAILED: {what}")


def largest(values):
    known = np.abs(values[np.isfinite(values)])
    return known.max() if known.size else 0.0


def write_drive(folder):
    begin_m = LVMS_M - BEFORE_LINE_M
    lines = recorded_drive.time_of(np.arange(1, LAPS + 2) * LVMS_M, begin_m)
    inside, over_line = SILENCES_S
    silences = ((lines[2] + 10, lines[2] + 10 + inside),
                (lines[4] - over_line / 2, lines[4] + over_line / 2))
    times = np.arange(0, lines[-1] + 5, recorded_drive.TICK_S)
    for silence in silences:
        times = times[(times < silence[0]) | (times > silence[1])]
    half = len(times) // 2
    for number, part in enumerate((times[:half], times[half:])):
        recorded_drive.write_segment(Path(folder) / f"pitwall_{number:05d}.mcap", part, LVMS_M,
                                     begin_m)
    return begin_m, lines


class Reckoned:
    """The laps of a recording by NumPy."""

    def __init__(self, recording, length_m, step_m):
        self.t, station = recording.column("track.station")
        turns = np.cumsum(np.concatenate([[0], np.diff(station) < -length_m / 2]))
        self.way = station + turns * length_m
        self.length_m, self.step_m = length_m, step_m
        self.speed = recording.column("ego.vx")

    @staticmethod
    def inside_gap(t, at):
        """Whether these moments lie between two samples that are a gap apart."""
        after = np.clip(np.searchsorted(t, at), 1, len(t) - 1)
        return t[after] - t[after - 1] > GAP_S

    def time_at(self, way):
        """When the car was first at these ways; NaN in a gap and outside."""
        first = np.concatenate([[True], np.diff(np.maximum.accumulate(self.way)) > 0])
        t, s = self.t[first], self.way[first]
        at = np.interp(way, s, t, left=np.nan, right=np.nan)
        after = np.clip(np.searchsorted(s, way), 1, len(s) - 1)
        from_sample = np.searchsorted(self.t, t[after])  # the sample before, wherever it was
        silent = self.t[from_sample] - self.t[from_sample - 1] > GAP_S
        return np.where(silent, np.nan, at)

    def crossing(self, turn):
        return self.time_at(np.array([turn * self.length_m]))[0]

    def points(self, turn, count):
        at = self.time_at(turn * self.length_m + np.arange(count) * self.step_m)
        speed = np.interp(at, *self.speed)
        speed[~np.isfinite(at) | self.inside_gap(self.speed[0], at)] = np.nan
        return at, speed


def check_laps(client, table, reckoned):
    """Lap times and points; the columns of complete laps by the turn of the track."""
    columns, worst = {}, {"lap time": 0.0, "point": 0.0, "speed": 0.0}
    turns = np.array([reckoned.crossing(turn) for turn in range(1, int(reckoned.way[-1] //
                                                                     reckoned.length_m) + 1)])
    complete = [lap for lap in table["laps"] if lap["time_s"] is not None]
    expect(len(complete) == np.isfinite(np.diff(turns)).sum(), "as many complete laps as NumPy's")
    for lap in complete:
        begin_s = lap["begin_ms"] / 1e3
        turn = int(np.nanargmin(np.abs(turns - begin_s))) + 1
        lap_s = turns[turn] - turns[turn - 1]
        worst["lap time"] = max(worst["lap time"], abs(lap["time_s"] - lap_s),
                                abs(begin_s - turns[turn - 1]))
        time_s, speed = client.lap(lap["id"])[:2].astype(float)
        at, expected = reckoned.points(turn, len(time_s))
        expect((np.isfinite(time_s) == np.isfinite(at)).all(), f"gaps of lap {lap['id']}")
        expect((np.isfinite(speed) == np.isfinite(expected)).all(),
               f"gaps of the speed of lap {lap['id']}")
        worst["point"] = max(worst["point"], largest(time_s - (at - turns[turn - 1])))
        worst["speed"] = max(worst["speed"], largest(speed - expected))
        columns[turn] = time_s
    print("differs from NumPy at most by", worst)
    for name, bound in (("lap time", LAP_S), ("point", POINT_S), ("speed", SPEED_MPS)):
        expect(worst[name] <= bound, f"{name}: {worst[name]} beyond {bound}")
    best = min(complete, key=lambda lap: lap["time_s"])
    expect(table["best"] == best["id"], "the best is the fastest complete lap")
    return columns


def check_truth(table, columns, begin_m, lines):
    """What only the drive that was written here knows."""
    incomplete = [lap for lap in table["laps"] if lap["time_s"] is None]
    # Before the first line, either side of the silent line, and after the last one.
    seen = [(lap["start_seen"], lap["finish_seen"]) for lap in incomplete]
    expect(seen == [(False, True), (True, False), (False, True), (True, False)], f"not {seen}")
    # Each from the last sample before a silence to the first one after it.
    gaps = [lap["gap_s"] for lap in table["laps"] if lap["gap_s"] > 0]
    expect(len(gaps) == len(SILENCES_S), f"gaps: {gaps}")
    for gap, silence in zip(gaps, SILENCES_S):
        expect(silence <= gap <= silence + 2 * recorded_drive.TICK_S, f"gaps: {gaps}")
    times = [lap["time_s"] for lap in table["laps"] if lap["time_s"] is not None]
    true = [b - a for i, (a, b) in enumerate(zip(lines, lines[1:])) if i not in (3, 4)]
    worst = largest(np.array(times) - np.array(true))
    print("lap times differ from the truth at most by", worst)
    expect(worst <= TRUE_LAP_S, f"lap time: {worst}")
    stations = np.arange(len(columns[1])) * 5.0

    def truly(turn):
        return recorded_drive.time_of(turn * LVMS_M + stations, begin_m) - lines[turn - 1]

    worst = max(largest(columns[turn] - columns[1] - (truly(turn) - truly(1)))
                for turn in columns if turn != 1)
    print("deltas differ from the truth at most by", worst)
    expect(worst <= TRUE_DELTA_S, f"delta: {worst}")


def check_history(client, field, recording):
    """Wherever it is played: every point is a sample, the extremes are there, the gaps are gaps."""
    t, value = recording.column("ego.vx")
    client.send(type="playback", to_ms=(t[-1] + 0.01) * 1e3, speed=0)
    at, shown = client.history(field, t[-1] - t[0] + 2, 20_000)
    known = np.isfinite(shown)
    expect(np.isin(shown[known], value.astype("<f4")).all(), "every point is a sample")
    expect(shown[known].min() == np.float32(value.min()), "the smallest is among them")
    expect(shown[known].max() == np.float32(value.max()), "the largest is among them")
    expect(abs(at[0] - t[0]) < 0.2 and abs(at[-1] - t[-1]) < 0.2, "from the begin to the end")
    gaps = (np.diff(t) > 1.0).sum()
    expect((~known).sum() == gaps, f"{gaps} gaps, not {(~known).sum()}")


def check(base, folder, drive):
    process = subprocess.Popen([base, "--replay", folder, "--track", "lvms", "--web", "0"],
                               stderr=subprocess.PIPE, text=True)
    try:
        line = process.stderr.readline()
        found = re.search(r"http://[\d.]+:(\d+)$", line.strip())
        expect(found, f"an address is said, not: {line}")
        port = int(found.group(1))
        client = ConsoleClient(port)
        catalogue = client.text("catalogue")
        field = next(f["id"] for f in catalogue["fields"] if f["path"] == "ego.vx")
        client.send(type="playback", speed=0)
        client.send(type="playback", to_ms=0)
        table = client.text("laps")
        recording = Recording(folder)
        reckoned = Reckoned(recording, table["length_m"], table["step_m"])
        columns = check_laps(client, table, reckoned)
        if drive:
            check_truth(table, columns, *drive)
        check_history(client, field, recording)
    finally:
        process.terminate()
        process.wait(20)


def main():
    if len(sys.argv) > 2:
        return check(sys.argv[1], sys.argv[2], None)
    with tempfile.TemporaryDirectory() as folder:
        check(sys.argv[1], folder, write_drive(folder))


main()

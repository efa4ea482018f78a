#!/usr/bin/env python3
"""What both ends say of key files that they refuse: refusals.py BASE VEHICLE TREE

Each program starts with keys as `keygen` makes them, and with each of the changes below it does
not: exit code 2, and a line with the place, what was found, what was expected and what to do.
"""
# SPDX-License-Identifier: Apache-2.0
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

BASE, VEHICLE, TREE = sys.argv[1], sys.argv[2], Path(sys.argv[3])
STRANGER = 54_321  # a user
NO_BUS = "nocan0"


def expect(condition, what):
    if not condition:
        sys.exit(f"FAILED: {what}")


def start_base(keys, *flags):
    return subprocess.run([BASE, "--keys", keys, "--listen", "127.0.0.1:0", "--duration", "0.1",
                           *flags], capture_output=True, text=True, timeout=20)


def start_car(keys, *flags):
    """On a bus that is none: what it says of that comes after the keys."""
    config = TREE / "vehicle/config"
    return subprocess.run([VEHICLE, "--car", config / "cars/av21.yaml", "--track",
                           config / "tracks/lvms.yaml", "--can", NO_BUS, "--gnss", "23501,23502",
                           "--keys", keys, *flags], capture_output=True, text=True, timeout=20)


def base_takes(keys, *flags):
    done = start_base(keys, *flags)
    expect(done.returncode == 0 and "listening at" in done.stderr, f"base: {done.stderr}")
    return done.stderr


def car_takes(keys, *flags):
    done = start_car(keys, *flags)
    expect(done.returncode == 2 and f"{NO_BUS}: error" in done.stderr, f"car: {done.stderr}")


def replace(line, value):
    def change(path, _):
        text = path.read_text()
        path.write_text(re.sub(rf"(?m)^{line}: .*$", f"{line}: {value}", text))
    return change


def own_key_as_peer(path, _):
    replace("peer", re.search(r"(?m)^public: (\w+)$", path.read_text())[1])(path, None)


def links_to_itself(path, _):
    path.rename(path.with_suffix(".real"))
    path.symlink_to(path.with_suffix(".real"))


def takes_the_other_file(path, other):
    path.write_text(other.read_text())


def mode(bits):
    return lambda path, _: path.chmod(bits)


def folder_mode(bits):
    return lambda path, _: path.parent.chmod(bits)


def owner(path, _):
    os.chown(path, STRANGER, -1)


def folder_owner(path, _):
    os.chown(path.parent, STRANGER, -1)


# What is changed, the place that is named (f"{file}", its line, or the folder), and what is said.
FILE, FOLDER = "{file}", "{folder}"
CHANGES = [
    *[(mode(bits), FILE, rf"has mode {bits:04o}, .* expected 0600: chmod 600 ")
      for bits in (0o640, 0o620, 0o604, 0o602, 0o644, 0o666)],
    (folder_mode(0o777), FOLDER, r"has mode 0777, .* expected 0755 or less: chmod go-w "),
    (folder_mode(0o770), FOLDER, r"has mode 0770, .* expected 0755 or less: chmod go-w "),
    (links_to_itself, FILE, r"is a symbolic link, expected the file itself: name "),
    (takes_the_other_file, FILE + ":2", r"these are the \w+'s keys, expected the \w+'s: give "),
    (replace("peer", "0" * 64), FILE + ":5",
     r"gives no shared secret .*, expected the public: .*keygen"),
    (replace("peer", "01" + "0" * 62), FILE + ":5", r"gives no shared secret "),
    (own_key_as_peer, FILE + ":5", r"is the own key, expected the public: .*keygen"),
]
OF_ROOT = [  # who else may give a file away
    (owner, FILE, rf"belongs to user {STRANGER}, expected user 0, .*: chown 0 "),
    (folder_owner, FOLDER, rf"belongs to user {STRANGER}, expected user 0, .*: chown 0 "),
]


def make_pair(folder, *flags):
    made = subprocess.run([BASE, "keygen", *flags, "--out", folder], check=True,
                          capture_output=True, text=True)
    return folder / "base.keys", folder / "car.keys", made.stdout


def both_ends_refuse(folder):
    changes = CHANGES + (OF_ROOT if os.geteuid() == 0 else [])
    for number, (change, place, said) in enumerate(changes):
        for end, (name, start) in enumerate((("base", start_base), ("car", start_car))):
            pair = make_pair(folder / f"{number}{name}")
            (base_takes if end == 0 else car_takes)(pair[end])
            secret = re.search(r"(?m)^secret: (\w+)$", pair[end].read_text())[1]
            change(pair[end], pair[1 - end])
            done = start(pair[end])
            told = place.format(file=pair[end], folder=pair[end].parent)
            expect(done.returncode == 2, f"{name}, {said}: exit {done.returncode} {done.stderr}")
            expect(re.search(re.escape(told) + ": error: .*" + said, done.stderr),
                   f"{name}, {told}: {said}: {done.stderr}")
            expect(secret not in done.stderr, "no secret is told")
    print(f"{len(changes)} changes, each refused by both ends")


def keys_of_a_bench_are_for_the_bench(folder):
    base, car, said = make_pair(folder / "bench", "--bench")
    log = folder / "keys.log"
    expect("KEYS OF A BENCH" in said, said)
    expect("KEYS OF A BENCH" in base_takes(base, "--key-log", log) and log.exists(), "the log")
    car_takes(car, "--simulation")
    done = start_car(car)
    expect(done.returncode == 2 and f"{car}:6: error: keys of a bench" in done.stderr,
           f"a real car: {done.stderr}")
    base, car, _ = make_pair(folder / "real")
    done = start_base(base, "--key-log", folder / "never.log")
    expect(done.returncode == 2 and "keygen --bench" in done.stderr, f"no log: {done.stderr}")
    expect(not (folder / "never.log").exists(), "and none is begun")


with tempfile.TemporaryDirectory(prefix="pitwall_keys_") as temporary:
    both_ends_refuse(Path(temporary))
    keys_of_a_bench_are_for_the_bench(Path(temporary))

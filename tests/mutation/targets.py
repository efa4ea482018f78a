# What is mutated and by which tests it is judged: the targets of a file in TOML, one table each.
#
#   [NAME]
#   sources    files that are mutated and compiled apart (C++ or TypeScript)
#   headers    headers that are mutated; for each mutant sources and tests are compiled
#   tests      test sources; their suites alone judge
#   support    further sources to compile and link; without it those in the folders of `sources`
#   enums      read for their enumerators only
#   program    the test program of the build whose libraries are linked; its build folder too
#
# SPDX-License-Identifier: Apache-2.0
import pathlib
import re
import tomllib
from dataclasses import dataclass, field

KEYS = {"sources", "headers", "tests", "support", "enums", "program"}
INCLUDE = re.compile(r'^#include [<"]([^>"]+)[>"]', re.MULTILINE)


@dataclass
class Target:
    name: str
    sources: list
    tests: list
    headers: list = field(default_factory=list)
    support: list = field(default_factory=list)
    enums: list = field(default_factory=list)
    program: str = ""
    libraries: list = field(default_factory=list)

    @property
    def is_typescript(self):
        return self.sources[0].endswith(".ts")

    @property
    def mutated(self):
        return self.sources + self.headers


def read(path, root, build):
    with open(path, "rb") as file:
        tables = tomllib.load(file)
    return [one(name, table, root, build) for name, table in tables.items()]


def one(name, table, root, build):
    unknown = set(table) - KEYS
    if unknown or not table.get("sources") or not table.get("tests"):
        raise ValueError(f"target {name}: needs sources and tests, knows no {sorted(unknown)}")
    target = Target(name, **table)
    for path in target.mutated + target.tests + target.support + target.enums:
        if not (root / path).is_file():
            raise ValueError(f"target {name}: there is no {path}")
    if target.is_typescript:
        return target
    if "support" not in table:
        target.support = neighbours(target, root)
    if target.program:
        target.libraries = libraries_of(target.program, build)
    return target


# The library that holds a source: compiled without optimisation like it, so that no caller beside
# it has the unchanged function inlined.
def neighbours(target, root):
    folders = sorted({pathlib.PurePath(path).parent for path in target.sources})
    found = [p for folder in folders for p in sorted((root / folder).glob("*.cpp"))]
    paths = [str(p.relative_to(root)) for p in found if p.name != "main.cpp"]
    return [path for path in paths if path not in target.sources]


def libraries_of(program, build):
    text = (build / "build.ninja").read_text()
    linking = rf"^build [^\n]*/{program}[ :][^\n]*_LINKER__.*?^  LINK_LIBRARIES = ([^\n]*)"
    rule = re.search(linking, text, re.MULTILINE | re.DOTALL)
    if rule is None:
        raise ValueError(f"the build has no test program {program}")
    parts = rule.group(1).split()
    return [str(build / p) if p.endswith(".a") and not p.startswith("/") else p for p in parts]


# Whether a header is one of these, or includes one, however far below.
def leads_to(header, these, root, seen):
    if header in these:
        return True
    if header in seen or not (root / header).is_file():
        return False
    seen.add(header)
    below = INCLUDE.findall((root / header).read_text())
    return any(leads_to(name, these, root, seen) for name in below)


# The headers of some sources that no mutant changes, to be compiled once.
def included(paths, mutated, root):
    found = []
    for path in paths:
        found += INCLUDE.findall((root / path).read_text())
    wanted = dict.fromkeys(found)
    return [header for header in wanted if not leads_to(header, mutated, root, set())]

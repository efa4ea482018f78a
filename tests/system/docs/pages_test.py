#!/usr/bin/env python3
"""Checks README.md and docs/*.md against the tree and the programs: pages_test.py TREE BUILD

Every relative link leads to a file. Every path of the tree that a page names exists. Every command
line names a program of the build, a subcommand that it knows, and options that the help of it
lists. README.md has at most 150 lines, and links to every page.
"""
# SPDX-License-Identifier: Apache-2.0
import re
import shlex
import subprocess
import sys
from pathlib import Path

TREE, BUILD = Path(sys.argv[1]), Path(sys.argv[2])
PROGRAMS = {"pitwall-hil": "hil", "pitwall-base": "basestation", "pitwall-vehicle": "vehicle",
            "pitwall-raceline": "vehicle/raceline"}
# Words at most.
SUBCOMMANDS = {"pitwall-hil": 2, "pitwall-base": 1, "pitwall-vehicle": 0, "pitwall-raceline": 0}
README_LINES_AT_MOST = 150
TOP_FOLDERS = r"(?:protocol|vehicle|basestation|hil|tests)/"
OF_OTHERS = {"public_recordings"}  # pages that name files of other projects

findings = []


def commands_of(text):
    """Lines of code without their comment; one that goes on in the next is one."""
    code = re.sub(r"\\\n\s*", "", "\n".join(re.findall(r"(?m)^    (.*)$", text)))
    return [re.sub(r"\s+#.*", "", line) for line in code.split("\n") if line]


def help_of(arguments):
    done = subprocess.run([*arguments, "--help"], capture_output=True, text=True, timeout=20)
    return done.stdout + done.stderr if done.returncode == 0 else None


def check_program(page, line, words):
    name = Path(words[0]).name
    program = BUILD / PROGRAMS[name] / name
    subcommand, text = [], help_of([program])
    for word in words[1:1 + SUBCOMMANDS[name]]:
        more = None if word.startswith("-") or not word.islower() else help_of(
            [program, *subcommand, word])
        if more is None:
            break
        subcommand, text = [*subcommand, word], more
    if name == "pitwall-hil" and not subcommand:
        findings.append(f"{page}: no such verb: {line}")
        return
    own = words[:words.index("--")] if "--" in words else words
    for option in {word.split("=")[0] for word in own if word.startswith("--")}:
        if not re.search(rf"{re.escape(option)}\b", text):
            findings.append(f"{page}: {name} {' '.join(subcommand)} has no {option}: {line}")


def check_launcher(page, line, words):
    text = subprocess.run([TREE / "pitwall", "help"], capture_output=True, text=True).stdout
    if not re.search(rf"^  {re.escape(words[1])}\b", text, re.M):
        findings.append(f"{page}: ./pitwall has no verb {words[1]}: {line}")


def check_line(page, line):
    for part in re.split(r" && | \| ", line):
        words = shlex.split(part)
        if words[0] == "sudo":
            words = words[1:]
        if words[0] == "./pitwall":
            check_launcher(page, line, words)
        elif Path(words[0]).name in PROGRAMS:
            check_program(page, line, words)


def check_page(path):
    page, text = path.relative_to(TREE), path.read_text()
    for link in re.findall(r"\]\(([^)#]+)[^)]*\)", text):
        if "://" not in link and not (path.parent / link).exists():
            findings.append(f"{page}: {link} leads nowhere")
    for name in re.findall(rf"`({TOP_FOLDERS}[\w/.-]*)`", "" if page.stem in OF_OTHERS else text):
        if not (TREE / name).exists() and not list(TREE.glob(f"{name}.*")):
            findings.append(f"{page}: the tree has no {name}")
    for line in commands_of(text):
        check_line(page, line)


def main():
    pages = [TREE / "README.md", *sorted((TREE / "docs").glob("*.md"))]
    for path in pages:
        check_page(path)
    readme = pages[0].read_text()
    if readme.count("\n") > README_LINES_AT_MOST:
        lines = readme.count("\n")
        findings.append(f"README.md has {lines} lines, {README_LINES_AT_MOST} at most")
    for path in pages[1:]:
        if f"(docs/{path.name})" not in readme:
            findings.append(f"README.md does not link to docs/{path.name}")
    print("\n".join(findings) or f"{len(pages)} pages, no finding")
    sys.exit(1 if findings else 0)


main()

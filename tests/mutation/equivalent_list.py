# The list of mutants that no test can kill, each with the reason. An entry is keyed by what the
# mutant does to its line, so that it outlives lines that move:
#
#   OPERATOR FILE
#   - the line as it is
#   + the line as the mutant has it
#   = why nobody can tell the two apart
#
# Entries are separated by empty lines; a reason goes on in further lines that begin with "=".
# SPDX-License-Identifier: Apache-2.0
from dataclasses import dataclass


@dataclass(frozen=True)
class Key:
    operator: str
    path: str
    before: str
    after: str

    def __str__(self):
        return f"{self.operator} {self.path}\n- {self.before}\n+ {self.after}"


def read(text, name):
    entries = {}
    block = []
    for number, line in enumerate(text.splitlines() + [""], 1):
        if line.startswith("#"):
            continue
        if line.strip():
            block.append(line)
        elif block:
            key, reason = entry(block, f"{name}:{number - len(block)}")
            if key in entries:
                raise ValueError(f"{name}:{number - len(block)}: listed twice")
            entries[key] = reason
            block = []
    return entries


def entry(block, place):
    kinds = "".join(line[0] for line in block[1:3])
    words = block[0].split()
    if len(block) < 4 or len(words) != 2 or kinds != "-+":
        raise ValueError(f"{place}: not OPERATOR FILE, - line, + line, = reason")
    if any(not line.startswith("= ") or not line[2:].strip() for line in block[3:]):
        raise ValueError(f"{place}: a reason begins with '= '")
    key = Key(words[0], words[1], block[1][1:].strip(), block[2][1:].strip())
    return key, " ".join(line[2:].strip() for line in block[3:])

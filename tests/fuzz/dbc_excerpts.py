#!/usr/bin/env python3
"""Short databases made of long ones, as seeds of a fuzzer: dbc_excerpts.py OUT FOLDER...

A file of up to MOST bytes is taken as it is. Of a longer one each few messages become a file of
their own, with what the database says about them and with the definitions of all. A fuzzer tries
hundreds of these in the time of one long file, and what a database can say is in them all the same.
"""
# SPDX-License-Identifier: Apache-2.0
import re
import sys
from pathlib import Path

MOST = 1024
BEGIN = re.compile(rb"^(?=[A-Z][A-Z_]+(?:[ \t]*:)?(?:[ \t\r]|$))", re.M)
# The identifier of the message that a statement is about.
ABOUT = re.compile(rb"^(?:BO_|BO_TX_BU_|VAL_|SIG_VALTYPE_|SG_MUL_VAL_|SIG_GROUP_|"
                   rb"CM_ (?:BO_|SG_)|BA_ \"[^\"]*\" (?:BO_|SG_))[ \t]+(\d+)")
OF_ALL = re.compile(rb"^(?:BU_|BA_DEF_|BA_DEF_DEF_|VAL_TABLE_|EV_|BA_ |CM_ )")


def excerpts(text):
    about, of_all = {}, []
    for statement in BEGIN.split(text):
        found = ABOUT.match(statement)
        if found:
            about.setdefault(found.group(1), []).append(statement)
        elif OF_ALL.match(statement):
            of_all.append(statement)
    # What is said of all goes round, so that each excerpt stays short.
    part = b""
    for number, said in enumerate(about.values()):
        more = b"".join(said + of_all[number::len(about)])
        if part and len(part) + len(more) > MOST:
            yield part
            part = b""
        part += more
    yield part


def main():
    out = Path(sys.argv[1])
    out.mkdir(parents=True, exist_ok=True)
    for folder in map(Path, sys.argv[2:]):
        for file in sorted(folder.rglob("*.dbc")):
            text = file.read_bytes()
            parts = [text] if len(text) <= MOST else list(excerpts(text))
            for number, part in enumerate(parts):
                (out / f"{file.stem}-{number}.dbc").write_bytes(part)


if __name__ == "__main__":
    main()

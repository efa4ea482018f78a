# SPDX-License-Identifier: Apache-2.0
"""Decodes with canmatrix, an independent implementation, on all cores.

canmatrix_oracle.py DBC < frames     frames: "<id> <extended 0/1> <hex payload>" a line

First a layout line for every signal:
  L <id> <extended> <bytes> <start> <length> <intel> <signed> <float> <scale> <offset> <signal>
then for every frame, in order, one line:
  F <signal>=<value>...      or      E <exception> where canmatrix cannot decode it
"""
import itertools
import multiprocessing
import sys

import canmatrix.formats

FRAMES = {}  # the workers are forks: the file is read once
CHUNK = 4000


def layout(frame):
    for s in frame.signals:
        print("L", frame.arbitration_id.id, int(frame.arbitration_id.extended), frame.size,
              s.get_startbit(bit_numbering=1), s.size, int(s.is_little_endian), int(s.is_signed),
              int(s.is_float), repr(float(s.factor)), repr(float(s.offset)), s.name)


def decoded(line):
    number, extended, payload = (line.rstrip("\n") + " ").split(" ")[:3]
    frame = FRAMES[(int(number), int(extended))]
    try:
        values = frame.decode(bytes.fromhex(payload))
        return "F " + " ".join(f"{n}={float(v.phys_value)!r}" for n, v in values.items())
    except Exception as error:
        return f"E {type(error).__name__} {error}".replace("\n", " ")


def decoded_chunk(lines):
    return "\n".join(decoded(line) for line in lines)


def chunks(stream):
    while lines := list(itertools.islice(stream, CHUNK)):
        yield lines


def main():
    database = canmatrix.formats.loadp_flat(sys.argv[1])
    for frame in database.frames:
        if frame.name == "VECTOR__INDEPENDENT_SIG_MSG":
            continue
        FRAMES[(frame.arbitration_id.id, int(frame.arbitration_id.extended))] = frame
        layout(frame)
    sys.stdout.flush()
    with multiprocessing.get_context("fork").Pool() as pool:
        for text in pool.imap(decoded_chunk, chunks(sys.stdin)):
            print(text)


if __name__ == "__main__":
    main()

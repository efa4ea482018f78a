# SPDX-License-Identifier: Apache-2.0
"""Decodes with canmatrix, an independent implementation.

canmatrix_oracle.py DBC < frames     frames: "<id> <extended 0/1> <hex payload>" a line

First a layout line for every signal:
  L <id> <extended> <bytes> <signal> <start> <length> <intel> <signed> <float> <scale> <offset>
then for every frame one line: F <signal>=<value>... or E where canmatrix cannot decode it.
"""
import sys

import canmatrix.formats


def layout(frame):
    for s in frame.signals:
        print("L", frame.arbitration_id.id, int(frame.arbitration_id.extended), frame.size, s.name,
              s.get_startbit(bit_numbering=1), s.size, int(s.is_little_endian), int(s.is_signed),
              int(s.is_float), repr(float(s.factor)), repr(float(s.offset)))


def main():
    database = canmatrix.formats.loadp_flat(sys.argv[1])
    frames = {}
    for frame in database.frames:
        if frame.name == "VECTOR__INDEPENDENT_SIG_MSG":
            continue
        frames[(frame.arbitration_id.id, int(frame.arbitration_id.extended))] = frame
        layout(frame)
    for line in sys.stdin:
        number, extended, payload = (line.rstrip("\n") + " ").split(" ")[:3]
        frame = frames.get((int(number), int(extended)))
        try:
            decoded = frame.decode(bytes.fromhex(payload))
            print("F", *(f"{name}={float(v.phys_value)!r}" for name, v in decoded.items()))
        except Exception:  # a selector value without signals
            print("E")


if __name__ == "__main__":
    main()

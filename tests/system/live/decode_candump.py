# SPDX-License-Identifier: Apache-2.0
"""decode_candump.py DBC CANDUMP_LOG EVERY: what python3-can reads and python3-canmatrix decodes.

One line for every EVERY-th frame: "<index> <id> <name>=<value> ..."; at the end "total <frames>".
"""
import sys

import can
import canmatrix.formats


def main():
    database = canmatrix.formats.loadp_flat(sys.argv[1])
    frames = {frame.arbitration_id.id: frame for frame in database.frames}
    every = int(sys.argv[3])
    total = 0
    with open(sys.argv[2]) as log:
        for message in can.CanutilsLogReader(log):
            if total % every == 0:
                decoded = frames[message.arbitration_id].decode(bytes(message.data))
                print(total, message.arbitration_id,
                      *(f"{name}={float(v.phys_value)!r}" for name, v in decoded.items()))
            total += 1
    print("total", total)


if __name__ == "__main__":
    main()

# SPDX-License-Identifier: Apache-2.0
"""A CAN log as python-can, an independent implementation, reads and writes it.

log_oracle.py read FORMAT FILE          FORMAT: candump, asc, blf, trc
log_oracle.py write FORMAT FILE < list  the list as `read` prints it

One line a message: stamp, channel, id, 0 or 1 each for extended, remote, FD, BRS, ESI, received,
then the length and the data in hex or "-"; "E" and the stamp for an error frame; "X", the stamp and
a reason for what python-can reads and its own check refuses; "Q" and a reason where it gives up.
"""
import sys

import can

READERS = {"candump": can.CanutilsLogReader, "asc": can.ASCReader, "blf": can.BLFReader,
           "trc": can.TRCReader}
WRITERS = {"candump": can.CanutilsLogWriter, "asc": can.ASCWriter, "blf": can.BLFWriter,
           "trc": can.TRCWriter}


def refused(message):
    """Why a message is no frame, by python-can's own check."""
    try:
        can.Message(timestamp=message.timestamp, arbitration_id=message.arbitration_id,
                    is_extended_id=message.is_extended_id,
                    is_remote_frame=message.is_remote_frame, is_fd=message.is_fd, dlc=message.dlc,
                    data=None if message.is_remote_frame else message.data,
                    bitrate_switch=message.bitrate_switch, check=True)
        return None
    except ValueError as error:
        return str(error).replace("\n", " ")


def line_of(message):
    if message.is_error_frame:
        return f"E {message.timestamp:.9f}"
    reason = refused(message)
    if reason:
        return f"X {message.timestamp:.9f} {reason}"
    flags = (message.is_extended_id, message.is_remote_frame, message.is_fd,
             message.bitrate_switch, message.error_state_indicator, message.is_rx)
    data = "-" if message.is_remote_frame or not message.data else bytes(message.data).hex()
    return (f"{message.timestamp:.9f} {message.channel} {message.arbitration_id} "
            f"{' '.join(str(int(f)) for f in flags)} {message.dlc} {data}")


def read(name, path):
    options = {"relative_timestamp": False} if name == "asc" else {}
    try:
        for message in READERS[name](path, **options):
            print(line_of(message))
    except ValueError as error:
        print("Q", str(error).replace("\n", " "))


def message_of(line):
    words = line.split()
    if words[0] == "E":
        return can.Message(timestamp=float(words[1]), is_error_frame=True)
    extended, remote, fd, brs, esi, received = (word == "1" for word in words[3:9])
    channel = int(words[1]) if words[1].isdigit() else words[1]
    data = None if words[10] == "-" else bytes.fromhex(words[10])
    return can.Message(timestamp=float(words[0]), channel=channel, arbitration_id=int(words[2]),
                       is_extended_id=extended, is_remote_frame=remote, is_fd=fd,
                       bitrate_switch=brs, error_state_indicator=esi, is_rx=received,
                       dlc=int(words[9]), data=data)


def write(name, path):
    with WRITERS[name](path) as writer:
        for line in sys.stdin:
            writer.on_message_received(message_of(line))


if __name__ == "__main__":
    {"read": read, "write": write}[sys.argv[1]](sys.argv[2], sys.argv[3])

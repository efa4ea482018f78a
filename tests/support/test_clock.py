# SPDX-License-Identifier: Apache-2.0
"""The clock of the programs that a test starts: bench time where real_time/in_bench_time keeps one,
else the wall's. A test that compares its own times with theirs takes them here."""
import os
import struct
import time
from pathlib import Path

FILE = os.environ.get("PITWALL_TEST_CLOCK")
FLAGS = ["--clock", FILE] if FILE else []  # of a program that goes by it
LOST_AT = 8  # in the page: protocol/transport/bench_clock/clock_page.hpp


def stood_ns():
    """How far bench time is behind the wall clock."""
    return struct.unpack_from("<q", Path(FILE).read_bytes(), LOST_AT)[0] if FILE else 0


def calendar_s():
    return time.time() - stood_ns() / 1e9


def monotonic_s():
    return time.monotonic() - stood_ns() / 1e9

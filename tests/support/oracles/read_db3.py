"""Reads a bag of ROS 2 in SQLite with Python's sqlite3, read only.

  python3 read_db3.py FILE
  out    a line for each message, in the order of writing: topic, type, stamp, hexadecimal digits

SPDX-License-Identifier: Apache-2.0
"""
import sqlite3
import sys

bag = sqlite3.connect(f"file:{sys.argv[1]}?mode=ro", uri=True)
rows = bag.execute("SELECT topics.name, topics.type, timestamp, data FROM messages "
                   "JOIN topics ON topics.id = topic_id ORDER BY messages.id")
for topic, kind, stamp, data in rows:
    print(topic, kind, stamp, data.hex())

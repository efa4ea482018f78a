"""Writes a bag of ROS 2 in SQLite with Python's sqlite3, as rosbag2_storage_sqlite3 does.

  node bag_messages.mjs COUNT | python3 write_db3.py FILE [--wal]
  --wal   leaves the write-ahead mode in the header

SPDX-License-Identifier: Apache-2.0
"""
import sqlite3
import sys

path, options = sys.argv[1], sys.argv[2:]
bag = sqlite3.connect(path)
if "--wal" in options:
    bag.execute("PRAGMA journal_mode=WAL")
bag.execute("CREATE TABLE schema(schema_version INTEGER PRIMARY KEY, ros_distro TEXT NOT NULL)")
bag.execute("INSERT INTO schema VALUES (3, 'humble')")
bag.execute(
    "CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT NOT NULL, type TEXT NOT NULL,"
    "serialization_format TEXT NOT NULL, offered_qos_profiles TEXT NOT NULL)")
bag.execute(
    "CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER NOT NULL,"
    "timestamp INTEGER NOT NULL, data BLOB NOT NULL)")
bag.execute("CREATE INDEX timestamp_idx ON messages (timestamp ASC)")
topics = {}
for line in sys.stdin:
    topic, kind, stamp, digits = line.split()
    if topic not in topics:
        topics[topic] = bag.execute(
            "INSERT INTO topics(name, type, serialization_format, offered_qos_profiles)"
            "VALUES (?, ?, 'cdr', '')", (topic, kind)).lastrowid
    data = bytes.fromhex(digits)
    bag.execute("INSERT INTO messages(topic_id, timestamp, data) VALUES (?, ?, ?)",
                (topics[topic], int(stamp), data))
bag.commit()
if "--wal" in options:
    bag.execute("PRAGMA wal_checkpoint(TRUNCATE)")
bag.close()

"""A console as a socket: the base's WebSocket (RFC 6455) and its messages, by a second hand."""
# SPDX-License-Identifier: Apache-2.0
import json
import os
import socket
import struct

import numpy as np

TEXT, BINARY = 1, 2
HISTORY, LAP = 2, 3
HEAD = 24


class ConsoleClient:
    def __init__(self, port):
        self.socket = socket.create_connection(("127.0.0.1", port), timeout=20)
        self.socket.sendall((f"GET /ws HTTP/1.1\r\nHost: 127.0.0.1:{port}\r\n"
                             "Upgrade: websocket\r\nConnection: Upgrade\r\n"
                             "Sec-WebSocket-Version: 13\r\n"
                             "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n").encode())
        self.bytes = b""
        while b"\r\n\r\n" not in self.bytes:
            self.more()
        head, self.bytes = self.bytes.split(b"\r\n\r\n", 1)
        assert b"101" in head.split(b"\r\n")[0], head

    def more(self):
        part = self.socket.recv(1 << 16)
        assert part, "the base has closed the connection"
        self.bytes += part

    def take(self, length):
        while len(self.bytes) < length:
            self.more()
        part, self.bytes = self.bytes[:length], self.bytes[length:]
        return part

    def message(self):
        kind, content, last = 0, b"", False
        while not last:
            first, length = self.take(2)
            if length >= 126:
                form = "!H" if length == 126 else "!Q"
                (length,) = struct.unpack(form, self.take(struct.calcsize(form)))
            last = first & 0x80 != 0
            kind = first & 0x0F or kind
            content += self.take(length)
        return kind, content

    def send(self, **message):
        content = json.dumps(message).encode()
        assert len(content) < 126
        mask = os.urandom(4)
        masked = bytes(byte ^ mask[i % 4] for i, byte in enumerate(content))
        self.socket.sendall(bytes([0x80 | TEXT, 0x80 | len(content)]) + mask + masked)

    def text(self, wanted):
        """The next text of this type."""
        while True:
            kind, content = self.message()
            if kind != TEXT:
                continue
            message = json.loads(content)
            assert message["type"] != "error", message
            if message["type"] == wanted:
                return message

    def frame(self, wanted):
        while True:
            kind, content = self.message()
            if kind == TEXT:
                message = json.loads(content)
                assert message["type"] != "error", message
            elif kind == BINARY and content[0] == wanted:
                return content

    def lap(self, number):
        """Time, speed, cross-track error, throttle and brake of the points of a lap."""
        self.send(type="lap", lap=number)
        content = self.frame(LAP)
        answered, columns, points = struct.unpack_from("<III", content, HEAD)
        assert answered == number and columns == 5
        return np.frombuffer(content, "<f4", columns * points, HEAD + 16).reshape(columns, points)

    def history(self, field, from_s, points):
        self.send(type="history", field=field, from_s=from_s, to_s=0, points=points)
        content = self.frame(HISTORY)
        answered, _, count = struct.unpack_from("<HHI", content, HEAD)
        assert answered == field
        rows = np.frombuffer(content, [("t", "<f8"), ("value", "<f4"), ("quality", "<u4")], count,
                             HEAD + 8)
        return rows["t"], rows["value"]

"""Headless Chromium, driven over its debugging pipe: no port, no package, one page at a time.

Chromium reads commands on descriptor 3 and answers on 4, JSON ended by a zero byte (Chrome DevTools
protocol). Everything that a page says to its console, and every request that it makes, is kept.
"""
# SPDX-License-Identifier: Apache-2.0
import base64
import json
import os
import select
import shutil
import subprocess
import time

START_LIMIT_S = 60.0


class Chromium:
    def __init__(self, profile, width, height):
        program = shutil.which("chromium-headless-shell")
        if program is None:
            raise SystemExit("the Debian package chromium-headless-shell is missing "
                             "(./pitwall setup installs it)")
        to_read, self._to = os.pipe()
        self._from, to_write = os.pipe()
        arguments = [program, "--no-sandbox", "--disable-gpu", "--no-first-run",
                     "--disable-dev-shm-usage", f"--user-data-dir={profile}",
                     f"--window-size={width},{height}", "--remote-debugging-pipe", "about:blank"]
        self._process = subprocess.Popen(
            ["bash", "-c", f'exec "$@" 3<&{to_read} 4>&{to_write}', "chromium", *arguments],
            pass_fds=(to_read, to_write), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        os.close(to_read)
        os.close(to_write)
        self._buffer, self._next, self._session = b"", 0, None
        self.events = []
        target = self.call("Target.createTarget", url="about:blank")["targetId"]
        self._session = self.call("Target.attachToTarget", targetId=target,
                                  flatten=True)["sessionId"]
        for domain in ("Page", "Runtime", "Log", "Network"):
            self.call(domain + ".enable")
        self.resize(width, height)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self._process.terminate()
        self._process.wait(20)

    def _receive(self, limit):
        while b"\0" not in self._buffer:
            left = limit - time.monotonic()
            if left <= 0 or not select.select([self._from], [], [], left)[0]:
                raise SystemExit("chromium does not answer")
            part = os.read(self._from, 1 << 20)
            if not part:
                raise SystemExit("chromium ended")
            self._buffer += part
        message, self._buffer = self._buffer.split(b"\0", 1)
        return json.loads(message)

    def call(self, method, **params):
        self._next += 1
        command = {"id": self._next, "method": method, "params": params}
        if self._session:
            command["sessionId"] = self._session
        os.write(self._to, json.dumps(command).encode() + b"\0")
        limit = time.monotonic() + START_LIMIT_S
        while True:
            message = self._receive(limit)
            if message.get("id") == self._next:
                if "error" in message:
                    raise SystemExit(f"{method}: {message['error']['message']}")
                return message["result"]
            if "method" in message:
                self.events.append((message["method"], message["params"]))

    def resize(self, width, height):
        self.call("Emulation.setDeviceMetricsOverride", width=width, height=height,
                  deviceScaleFactor=1, mobile=False)

    def open(self, path):
        self.events.clear()
        self.call("Page.navigate", url="file://" + path)
        limit = time.monotonic() + START_LIMIT_S
        while not any(method == "Page.loadEventFired" for method, _ in self.events):
            message = self._receive(limit)
            if "method" in message:
                self.events.append((message["method"], message["params"]))

    def evaluate(self, script):
        answer = self.call("Runtime.evaluate", expression=script, returnByValue=True)
        if "exceptionDetails" in answer:
            raise SystemExit("script of the test: " + json.dumps(answer["exceptionDetails"]))
        return answer["result"].get("value")

    def move_pointer(self, x, y):
        self.call("Input.dispatchMouseEvent", type="mouseMoved", x=x, y=y)

    def complaints(self):
        """What the page said to its console, and what it threw."""
        kinds = ("Runtime.exceptionThrown", "Runtime.consoleAPICalled", "Log.entryAdded")
        return [params for method, params in self.events if method in kinds]

    def requests(self):
        return [params["request"]["url"] for method, params in self.events
                if method == "Network.requestWillBeSent"]

    def screenshot(self, path, whole_page):
        picture = self.call("Page.captureScreenshot", captureBeyondViewport=whole_page,
                            **({"clip": self._whole()} if whole_page else {}))
        with open(path, "wb") as file:
            file.write(base64.b64decode(picture["data"]))

    def _whole(self):
        size = self.call("Page.getLayoutMetrics")["cssContentSize"]
        return {"x": 0, "y": 0, "width": size["width"], "height": size["height"], "scale": 1}

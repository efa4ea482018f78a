"""Who may come in to a base that serves consoles and Foxglove by TLS, as curl and OpenSSL see it:
certificates, versions, plain HTTP, tokens, cookies, and what is told of tokens."""
# SPDX-License-Identifier: Apache-2.0
import json
import re
import shutil
import signal
import ssl
import socket
import subprocess
import sys
import tempfile
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[2] / "support"))
import test_clock  # noqa: E402

BASE = sys.argv[1]
OPERATOR, VIEWER = "anna-4f1c9a7be2d05586", "garage-88f7d1c2a95be340"
READER = "reader-5be34088f7d1c2a9"
EXPIRED, WRONG_HOST, UNTRUSTED = 60, 60, 60  # curl's exit code: the peer's certificate is no good
NO_HANDSHAKE = 35
UPGRADE = ["-H", "Upgrade: websocket", "-H", "Connection: Upgrade",
           "-H", "Sec-WebSocket-Version: 13", "-H", "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ=="]


def expect(condition, what):
    if not condition:
        sys.exit(f"FAILED: {what}")


def openssl(*words, text=None):
    subprocess.run(["openssl", *map(str, words)], check=True, capture_output=True, input=text)


class Authority:
    """A certificate authority of this test, and what it signs."""

    def __init__(self, folder):
        self.folder = folder
        self.file = folder / "ca.pem"
        openssl("req", "-x509", "-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:P-256", "-nodes",
                "-keyout", folder / "ca.key", "-out", self.file, "-subj", "/CN=test authority",
                "-days", "2")

    def sign(self, name, host, days=2):
        key, request, out = (self.folder / f"{name}.{kind}" for kind in ("key", "csr", "pem"))
        openssl("req", "-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:P-256", "-nodes", "-keyout",
                key, "-out", request, "-subj", f"/CN={host}")
        extensions = self.folder / f"{name}.ext"
        extensions.write_text(f"subjectAltName=DNS:{host},IP:127.0.0.1\n" if host == "pit.local"
                              else f"subjectAltName=DNS:{host}\n")
        openssl("x509", "-req", "-in", request, "-CA", self.file, "-CAkey", self.folder / "ca.key",
                "-CAcreateserial", "-out", out, "-days", days, "-extfile", extensions)
        key.chmod(0o600)
        return out, key


class Base:
    def __init__(self, folder, certificate, key, *flags):
        tokens, readers = folder / "tokens", folder / "readers"
        self.process = subprocess.Popen(
            [BASE, "--keys", folder / "keys/base.keys", "--listen", "127.0.0.1:0", "--web", "0",
             "--web-name", "pit.local", "--web-tokens", tokens, "--web-certificate", certificate,
             "--web-key", key, "--foxglove", "0", "--foxglove-tokens", readers,
             *test_clock.FLAGS, *flags],
            stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.said = ""
        while "Foxglove at" not in self.said:
            line = self.process.stderr.readline()
            expect(line, f"the base ended: {self.said}")
            self.said += line
        self.port = int(re.search(r"console at https://127\.0\.0\.1:(\d+)", self.said).group(1))
        self.foxglove = int(re.search(r"Foxglove at wss://127\.0\.0\.1:(\d+)", self.said).group(1))

    def close(self):
        self.process.send_signal(signal.SIGTERM)
        shown, said = self.process.communicate(timeout=30)
        self.said += shown + said


def curl(url, authority, *flags):
    """The exit code, the status and the answer with its head."""
    words = ["curl", "-s", "-i", "--max-time", "20", "--noproxy", "*", "-w", "\n%{http_code}"]
    words += flags
    if authority is not None:
        words += ["--cacert", authority.file]
    ran = subprocess.run([*words, url], capture_output=True, text=True, errors="replace")
    answer, _, status = ran.stdout.rpartition("\n")
    return ran.returncode, int(status or 0), answer


def certificates_are_judged(folder, authority):
    certificate, key = authority.sign("good", "pit.local")
    base = Base(folder, certificate, key)
    here = f"https://127.0.0.1:{base.port}/"
    code, status, _ = curl(here, authority)
    expect((code, status) == (0, 200), f"the page comes by TLS, not {code} {status}")
    expect(curl(here, None)[0] == UNTRUSTED, "an authority that nobody knows is refused")
    for least, most in (("1.2", "1.2"), ("1.3", "1.3")):
        code, status, _ = curl(here, authority, f"--tlsv{least}", "--tls-max", most)
        expect((code, status) == (0, 200), f"TLS {most} is spoken: {code}")
    code, _, _ = curl(here, authority, "--tlsv1.0", "--tls-max", "1.1", "--ciphers",
                      "DEFAULT@SECLEVEL=0")
    expect(code == NO_HANDSHAKE, f"TLS 1.1 is not: {code}")
    for path, upgrade in (("/", []), ("/ws", UPGRADE), ("/api/session", [])):
        code, status, answer = curl(f"http://127.0.0.1:{base.port}{path}", None, *upgrade)
        expect((code, status) == (0, 400) and "HTTPS and WSS only" in answer,
               f"plain HTTP is refused with a line: {code} {status} {answer}")
    code, status, _ = curl(f"http://127.0.0.1:{base.foxglove}/{READER}", None, *UPGRADE)
    expect(status == 400, f"and at Foxglove's port: {status}")
    base.close()
    for name, host, days, what in (("expired", "pit.local", -1, "has expired"),
                                   ("other", "elsewhere.local", 2, None)):
        wrong = Base(folder, *authority.sign(name, host, days))
        code, status, _ = curl(f"https://127.0.0.1:{wrong.port}/", authority)
        expect(code in (EXPIRED, WRONG_HOST) and status == 0, f"{name} is refused: {code}")
        expect(what is None or what in wrong.said, f"{name} is said at the start: {wrong.said}")
        wrong.close()


def nobody_sees_anything_without_a_token(folder, authority):
    base = Base(folder, *authority.sign("tokens", "pit.local"))
    here = f"https://127.0.0.1:{base.port}"
    for path in ("/api/cars", "/api/catalogue", "/api/track", "/api/recordings", "/api/session",
                 "/api/layouts/primary", "/metrics"):
        expect(curl(here + path, authority)[1] == 401, f"{path} without a token")
    for wrong in ("", f"Authorization: Bearer {READER}", "Cookie: pitwall=1",
                  f"Cookie: pitwall-{base.port}={OPERATOR}"):
        flags = ["--http1.1", *UPGRADE] + (["-H", wrong] if wrong else [])
        expect(curl(here + "/ws", authority, *flags)[1] == 401, f"no console by {wrong!r}")
    for path in ("/", f"/{OPERATOR}", f"/{VIEWER}", "/0000000000000000"):
        flags = ["--http1.1", *UPGRADE, "-H", "Sec-WebSocket-Protocol: foxglove.sdk.v1"]
        status = curl(f"https://127.0.0.1:{base.foxglove}{path}", authority, *flags)[1]
        expect(status == 401, f"no Foxglove by {path}: {status}")
    expect(curl(f"{here}/api/cars?token={OPERATOR}", authority)[1] == 400,
           "a token in an address is refused, a good one too")
    base.close()
    for token in (OPERATOR, VIEWER, READER):
        expect(token not in base.said, "no token is logged")


def web_socket(port, authority, path, *heads):
    """An open WebSocket; None where it was refused."""
    context = ssl.create_default_context(cafile=str(authority.file))
    wire = context.wrap_socket(socket.create_connection(("127.0.0.1", port), timeout=20),
                               server_hostname="127.0.0.1")
    lines = [f"GET {path} HTTP/1.1", f"Host: 127.0.0.1:{port}", *UPGRADE[1::2], *heads, "", ""]
    wire.sendall("\r\n".join(lines).encode())
    answer = wire.recv(4096)
    return wire if b" 101 " in answer else None


def ends(wire):
    """Whether the other end closes it, whatever it says before."""
    try:
        while wire.recv(65536):
            pass
    except (ConnectionResetError, ssl.SSLError):
        pass
    except TimeoutError:
        return False
    return True


def a_login_gives_a_cookie_and_a_line_taken_away_ends_it(folder, authority):
    base = Base(folder, *authority.sign("login", "pit.local"))
    here = f"https://127.0.0.1:{base.port}"
    jar = folder / "jar"
    flags = ["-X", "POST", "-d", json.dumps({"token": OPERATOR}), "-c", jar]
    _, status, answer = curl(here + "/api/session", authority, *flags)
    cookie = re.search(r"^set-cookie: (.*)$", answer, re.I | re.M)
    expect(status == 204 and cookie, f"a login is answered with a cookie: {status}")
    for part in ("; Secure", "; HttpOnly", "; SameSite=Strict", "__Host-"):
        expect(part in cookie.group(1), f"the cookie has {part}: {cookie.group(1)}")
    expect(OPERATOR not in answer, "and does not tell the token")
    _, status, answer = curl(here + "/api/session", authority, "-b", jar)
    expect(status == 200 and '"role": "operator"' in answer, f"the cookie is Anna: {answer}")
    _, status, _ = curl(here + "/api/session", authority, "-X", "POST", "-d",
                        json.dumps({"token": OPERATOR}), "-H", "Origin: https://evil.example")
    expect(status == 403, "a page of somebody else does not log in")
    held = f"Cookie: {cookie.group(1).split(';')[0]}"
    console = web_socket(base.port, authority, "/ws", held)
    expect(console, "the cookie opens a console")
    reader = web_socket(base.foxglove, authority, f"/{READER}",
                        "Sec-WebSocket-Protocol: foxglove.sdk.v1")
    expect(reader, "a reader's token opens Foxglove")
    time.sleep(0.1)  # a file system's clock may be coarse
    (folder / "tokens").write_text(f"viewer {VIEWER} Garage\n")
    (folder / "readers").write_text("# nobody\n")
    expect(ends(console) and ends(reader), "who came by a line that is taken away has to go")
    expect(curl(here + "/api/session", authority, "-b", jar)[1] == 401, "and its cookie is none")
    expect(web_socket(base.foxglove, authority, f"/{READER}",
                      "Sec-WebSocket-Protocol: foxglove.sdk.v1") is None, "nor the reader's token")
    base.close()
    expect("Anna" in base.said and OPERATOR not in base.said, f"it is said who: {base.said}")


def write_tokens(folder):
    for name, text in (("tokens", f"operator {OPERATOR} Anna\nviewer {VIEWER} Garage\n"),
                       ("readers", f"viewer {READER} Plots\n")):
        (folder / name).write_text(text)
        (folder / name).chmod(0o600)


def main():
    folder = Path(tempfile.mkdtemp(prefix="pitwall-access-"))
    try:
        subprocess.run([BASE, "keygen", "--out", folder / "keys"], check=True, capture_output=True)
        authority = Authority(folder)
        for check in (certificates_are_judged, nobody_sees_anything_without_a_token,
                      a_login_gives_a_cookie_and_a_line_taken_away_ends_it):
            write_tokens(folder)
            check(folder, authority)
            print(f"ok: {check.__name__.replace('_', ' ')}")
    finally:
        shutil.rmtree(folder)


main()

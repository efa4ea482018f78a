#!/usr/bin/env python3
"""`./pitwall install base` into a folder: install_station_test.py SOURCE BUILD [TEST]..."""
# SPDX-License-Identifier: Apache-2.0
import http.client
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SOURCE, BUILD = Path(sys.argv[1]), Path(sys.argv[2])
INSTALLER = SOURCE / "basestation/settings/install/install_station.sh"
PROGRAM = "opt/pitwall/bin/pitwall-base"
DISSECTOR = "usr/lib/x86_64-linux-gnu/wireshark/plugins/pitwall.lua"
PATIENCE_S = 60


class Installation(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="pitwall_install_")
        self.addCleanup(folder.cleanup)
        self.root = Path(folder.name) / "root of the base"
        self.root.mkdir()

    def install(self, *arguments, expect=0, program=(INSTALLER, "base")):
        done = subprocess.run([*program, "--root", self.root, "--build", BUILD, *arguments],
                              text=True, capture_output=True)
        self.assertEqual(done.returncode, expect, done.stdout + done.stderr)
        return done.stderr if expect else done.stdout

    def found(self):
        return {str(path.relative_to(self.root)) for path in self.root.rglob("*")}

    def test_a_wrong_command_line_is_refused_by_name_and_changes_nothing(self):
        for wrong in [("--wireshark", "/tmp"), ("--wireshark",), ("--root", "/"),
                      ("--build", "/no"), ("--can", "can0"), ("extra",)]:
            with self.subTest(wrong=wrong):
                self.assertIn(wrong[0], self.install(*wrong, expect=2))
        self.assertEqual(self.found(), set())

    def test_the_dry_run_says_what_is_done_and_the_uninstall_undoes_it(self):
        plan = self.install("--dry-run")
        self.assertEqual(self.found(), set())
        self.assertEqual(self.install(), plan)
        listed = {line.split(maxsplit=1)[1] for line in plan.splitlines()
                  if line.startswith(("create", "enable"))}
        listed = {re.split(r" root:root| \S+:\S+ 0| -> ", line)[0].strip("/") for line in listed}
        self.assertEqual(listed, self.found())
        again = self.install()
        self.assertNotRegex(again, r"(?m)^(create|replace|enable|remove)")
        self.install("--uninstall")
        self.assertEqual(self.found(), set())

    def test_the_launcher_passes_it_on(self):
        launcher = self.install("--dry-run", program=(SOURCE / "pitwall", "install", "base"))
        self.assertEqual(launcher, self.install("--dry-run"))

    def test_the_dissector_goes_where_it_is_told_or_nowhere(self):
        self.assertNotIn("pitwall.lua", self.install("--dry-run", "--no-wireshark"))
        elsewhere = "/usr/lib/aarch64-linux-gnu/wireshark/plugins"
        plan = self.install("--dry-run", "--wireshark", elsewhere)
        self.assertIn(f"{elsewhere}/pitwall.lua", plan)

    def test_what_was_installed_works_without_the_tree(self):
        self.install()
        folder = self.root.parent
        plugins = folder / ".local/lib/wireshark/plugins"
        plugins.mkdir(parents=True)
        (plugins / "pitwall.lua").symlink_to(self.root / DISSECTOR)
        lua = subprocess.run(["tshark", "-G", "protocols"], text=True, capture_output=True,
                             env={"HOME": str(folder), "PATH": "/usr/bin:/bin"})
        self.assertRegex(lua.stdout, r"(?m)^Pitwall telemetry\tPITWALL\tpitwall")
        subprocess.run([self.root / PROGRAM, "keygen", "--out", folder / "keys"], check=True,
                       capture_output=True)
        base = subprocess.Popen(
            [self.root / PROGRAM, "--keys", folder / "keys/base.keys", "--listen", "127.0.0.1:0",
             "--web", "0", "--track", "lvms", "--duration", str(PATIENCE_S)],
            text=True, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
        try:
            said = next(line for line in base.stderr if "console at" in line)
            port = int(re.search(r":(\d+)\s*$", said)[1])
            for path, word in [("/", "<!doctype html"), ("/api/track", "centre")]:
                asked = http.client.HTTPConnection("127.0.0.1", port, timeout=PATIENCE_S)
                asked.request("GET", path)
                answer = asked.getresponse()
                text = answer.read().decode()
                self.assertEqual(answer.status, 200)
                self.assertIn(word, text.lower()[:2_000])
                asked.close()
        finally:
            base.kill()
            base.communicate()


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[3:])

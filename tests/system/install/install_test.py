#!/usr/bin/env python3
"""`./pitwall install car` into a folder: install_test.py SOURCE BUILD [TEST]..."""
# SPDX-License-Identifier: Apache-2.0
import os
import re
import resource
import shutil
import stat
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import unit_files

SOURCE, BUILD = Path(sys.argv[1]), Path(sys.argv[2])
INSTALLER = SOURCE / "vehicle/config/install/install.sh"
UNIT = "etc/systemd/system/pitwall-vehicle.service"
GUARDIAN_UNIT = "etc/systemd/system/pitwall-guardian.service"
NETWORK = "etc/systemd/network/70-pitwall-can0.network"
ENVIRONMENT = "etc/pitwall/vehicle.env"
MANIFEST = "var/lib/pitwall/install.manifest"
NETWORKD = "etc/systemd/system/multi-user.target.wants/systemd-networkd.service"
MORE_THAN_A_TEXT_LESS_THAN_A_PROGRAM = 64 << 10  # bytes


def snapshot(root):
    """Every path with all that an installation could change, time of change included."""
    found = {}
    for path in sorted(root.rglob("*")):
        about = path.lstat()
        content = (os.readlink(path) if path.is_symlink()
                   else path.read_bytes() if path.is_file() else None)
        changed = None if path.is_dir() else about.st_mtime_ns
        found[str(path.relative_to(root))] = (stat.filemode(about.st_mode), changed, content)
    return found


def lines_of(text, action):
    return [line for line in text.splitlines() if re.match(rf"{action} +/", line)]


class Installation(unittest.TestCase):
    plain = None  # the installation without options into an empty root, and what it said
    plain_root = tempfile.TemporaryDirectory(prefix="pitwall_install_plain_")

    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="pitwall_install_")
        self.addCleanup(folder.cleanup)
        self.root = Path(folder.name) / "root of the car"
        self.root.mkdir()

    def run_installer(self, *arguments, expect=0, program=INSTALLER, **options):
        done = subprocess.run([program, *arguments], text=True, capture_output=True, **options)
        self.assertEqual(done.returncode, expect, done.stdout + done.stderr)
        return done

    def install(self, *arguments, **options):
        """The installer takes seconds: most tests begin with a copy of one plain installation."""
        plain = not arguments and not options and not any(self.root.iterdir())
        if plain and Installation.plain:
            shutil.copytree(Installation.plain_root.name, self.root, symlinks=True,
                            dirs_exist_ok=True)
            return Installation.plain
        done = self.run_installer("car", "--root", self.root, "--build", BUILD, *arguments,
                                  **options)
        if plain:
            shutil.copytree(self.root, Installation.plain_root.name, symlinks=True,
                            dirs_exist_ok=True)
            Installation.plain = done
        return done

    def write(self, path, text):
        file = self.root / path
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text)
        return file

    def text(self, path):
        return (self.root / path).read_text()

    # --- the command line

    def test_a_wrong_command_line_is_refused_by_name_and_changes_nothing(self):
        car = Path(self.root).parent / "car with blank.yaml"
        car.touch()
        wrong = [("--bitrate", "0"), ("--bitrate", "9999"), ("--bitrate", "1000001"),
                 ("--bitrate", "500k"), ("--bitrate", "-5"), ("--bitrate", "08000"), ("--bitrate",),
                 ("--restart-ms", "-1"), ("--restart-ms", "60001"), ("--restart-ms", "1.5"),
                 ("--can", ""), ("--can", "can/0"), ("--can", "can 0"), ("--can", "a" * 16),
                 ("--can", "vcan0"), ("--can", "can0;reboot"), ("--can", "--arm"),
                 ("--radio", "10.0.0.1"), ("--radio", "10.0.0.256:1"), ("--radio", "base:23431"),
                 ("--radio", "10.0.0.1:0"), ("--radio", "10.0.0.1:65536"), ("--radio", ":1"),
                 ("--radio", "10.0.0.1:1,"), ("--radio", "10.0.0.1:1, 10.0.0.2:1"),
                 ("--radio", "10.0.0.1:1,10.0.0.2"), ("--radio", "10.0.0.1:65536,10.0.0.2:1"),
                 ("--radio", ",".join(f"10.0.0.{i}:1" for i in range(5))),
                 ("--radio", "10.0.0.1:1,10.0.0.1:1"), ("--radio", "10.0.0.1:1,127.0.0.1:1"),
                 ("--gnss", "23501"), ("--gnss", "23501,23501"), ("--gnss", "1,65536"),
                 ("--gnss", "0,1"), ("--gnss", "1,2,3"), ("--guardian-gnss", "5,5"),
                 ("--receiver", "udp:23501"), ("--receiver", "2=udp:23501"),
                 ("--receiver", "0=udp:65536"), ("--receiver", "0=tcp:3001"),
                 ("--receiver", "0=tcp:receiver:3001"), ("--receiver", "0=serial:ttyS0"),
                 ("--receiver", "0=serial:/dev/tty S0"), ("--receiver", "0=udp:23502"),
                 ("--guardian-receiver", "1=udp:23502"), ("--guardian-receiver", "1=file:/x"),
                 ("--car", "/nonexistent.yaml"), ("--car", "/etc"), ("--car", str(car)),
                 ("--track", "/etc/hostname"), ("--keys", "/nonexistent"),
                 ("--keys", "/etc/hostname"), ("--root", "/nonexistent"), ("--root", "/"),
                 ("--build", "/nonexistent"), ("--arm",), ("--simulation",), ("extra",)]
        for arguments in wrong:
            with self.subTest(arguments=arguments):
                said = self.install(*arguments, expect=2).stderr
                self.assertIn(arguments[0], said)
        self.assertEqual(snapshot(self.root), {})

    def test_what_to_install_has_to_be_said(self):
        for arguments in [(), ("base",), ("--dry-run",), ("",)]:
            self.assertIn("car", self.run_installer(*arguments, expect=2).stderr)

    def test_uninstall_takes_no_settings(self):
        self.assertIn("--can", self.install("--uninstall", "--can", "can1", expect=2).stderr)

    def test_a_car_file_that_the_car_process_refuses_is_never_installed(self):
        broken = self.root.parent / "broken.yaml"
        good = (SOURCE / "vehicle/config/cars/av21.yaml").read_text()
        broken.write_text(good + "\nunheard_of: 1\n")
        said = self.install("--car", broken, expect=2).stderr
        self.assertRegex(said, r"broken\.yaml:\d+:\d+: .*unheard_of")
        self.assertEqual(snapshot(self.root), {})

    def test_the_files_that_a_car_file_is_like_are_installed_with_it(self):
        self.install("--car", SOURCE / "vehicle/config/cars/av21_race.yaml",
                     "--track", SOURCE / "vehicle/config/tracks/tms.yaml")
        cars = self.root / "etc/pitwall/cars"
        self.assertEqual({file.name for file in cars.iterdir()}, {"av21_race.yaml", "av21.yaml"})
        (self.root.parent / "av21.yaml").write_text(
            (SOURCE / "vehicle/config/cars/av21.yaml").read_text())
        elsewhere = self.root.parent / "cars/elsewhere.yaml"
        elsewhere.parent.mkdir()
        elsewhere.write_text("schema: 1\nlike: ../av21.yaml\n")
        self.assertIn("like: ../av21.yaml", self.install("--car", elsewhere, expect=2).stderr)

    # --- the dry run

    def test_a_dry_run_says_exactly_what_the_installation_does_and_changes_nothing(self):
        self.write("etc/hostname", "car\n")
        before = snapshot(self.root)
        plan = self.install("--dry-run").stdout
        self.assertEqual(snapshot(self.root), before)
        self.assertEqual(self.install().stdout, plan)
        listed = {line.split()[1].strip("/") for line in plan.splitlines()
                  if line.split()[0] in ("create", "enable")}
        self.assertEqual(listed, set(snapshot(self.root)) - set(before))

    def test_a_dry_run_over_an_older_installation_shows_the_difference(self):
        self.install()
        before = snapshot(self.root)
        change = ("--bitrate", "250000")
        plan = self.install(*change, "--dry-run").stdout
        self.assertEqual(snapshot(self.root), before)
        self.assertEqual([line.split()[1] for line in lines_of(plan, "replace")],
                         ["/" + NETWORK, "/" + MANIFEST])
        self.assertIn("\n-BitRate=500000\n+BitRate=250000\n", plan)
        self.assertEqual(self.install(*change).stdout, plan)
        self.assertIn("BitRate=250000\n", self.text(NETWORK))

    def test_the_launcher_passes_a_dry_run_on(self):
        launcher = self.run_installer("install", "car", "--root", self.root, "--build", BUILD,
                                      "--dry-run", program=SOURCE / "pitwall").stdout
        self.assertEqual(launcher, self.install("--dry-run").stdout)
        self.assertEqual(snapshot(self.root), {})

    # --- what is put in place

    def test_owner_modes_and_no_name_left_open(self):
        out = self.install().stdout
        for path, (mode, _, content) in snapshot(self.root).items():
            wanted = ("lrwxrwxrwx" if mode[0] == "l" else "drwxr-xr-x" if mode[0] == "d" else
                      "-rwxr-xr-x" if path.startswith("opt/") else "-rw-r--r--")
            self.assertEqual(mode, wanted, path)
            if isinstance(content, bytes) and not path.startswith("opt/"):
                self.assertIsNone(re.search(rb"@[A-Z_]+@", content), path)
        for line in lines_of(out, "create"):
            self.assertRegex(line, r" \S+:\S+ 0(755|644)\b")

    def test_programs_and_files_are_those_of_the_build_and_the_tree(self):
        self.install()
        for name, origin in [("opt/pitwall/bin/pitwall-vehicle", BUILD / "vehicle/pitwall-vehicle"),
                             ("opt/pitwall/bin/pitwall-guardian",
                              BUILD / "vehicle/guardian/pitwall-guardian"),
                             ("opt/pitwall/bin/pitwall-hil", BUILD / "hil/pitwall-hil"),
                             ("etc/pitwall/cars/av21.yaml",
                              SOURCE / "vehicle/config/cars/av21.yaml"),
                             ("etc/pitwall/tracks/lvms.yaml",
                              SOURCE / "vehicle/config/tracks/lvms.yaml")]:
            self.assertEqual((self.root / name).read_bytes(), origin.read_bytes(), name)

    def test_the_car_is_never_armed(self):
        self.install()
        for path, (_, _, content) in snapshot(self.root).items():
            if isinstance(content, bytes) and not path.startswith("opt/"):
                self.assertNotIn(b"--arm", content, path)

    def command_of(self, unit):
        """What the unit starts, in the image."""
        environment = dict(line.split("=", 1) for line in self.text(ENVIRONMENT).splitlines()
                           if line and not line.startswith("#"))
        start = unit_files.read(self.text(unit))["Service", "ExecStart"][0]
        command = re.sub(r"\$\{(\w+)\}", lambda name: environment[name[1]], start)
        command = command.replace("%d/", "/etc/pitwall/").split()  # the service's credentials
        return [f"{self.root}{part}" if part.startswith(("/etc", "/opt")) else part
                for part in command]

    def test_the_unit_starts_a_process_that_the_car_process_accepts(self):
        self.install("--track", SOURCE / "vehicle/config/tracks/ims.yaml",
                     "--keys", self.make_keys() / "car.keys")
        self.assertIn("PITWALL_TRACK=/etc/pitwall/tracks/ims.yaml\n", self.text(ENVIRONMENT))
        program, *arguments = self.command_of(UNIT)
        self.run_installer(*arguments, "--check", program=program)

    def test_spare_stations_reach_the_car_process_as_one_argument(self):
        stations = "10.42.0.1:23431,10.42.0.2:23431"
        self.install("--radio", stations, "--keys", self.make_keys() / "car.keys")
        program, *arguments = self.command_of(UNIT)
        self.assertEqual(arguments[arguments.index("--radio") + 1], stations)
        self.run_installer(*arguments, "--check", program=program)
        again = self.install("--radio", stations).stdout
        self.assertNotIn("telemetry stays on this machine", again)

    # --- the keys of the radio

    def make_keys(self):
        folder = Path(tempfile.mkdtemp(dir=self.root.parent))
        self.run_installer("keygen", "--out", folder / "keys",
                           program=BUILD / "basestation/pitwall-base")
        return folder / "keys"

    def test_the_keys_are_roots_alone_and_never_shown(self):
        keys = self.make_keys() / "car.keys"
        first = self.install("--keys", keys).stdout
        there = self.root / "etc/pitwall/car.keys"
        self.assertEqual(stat.S_IMODE(there.stat().st_mode), 0o600)
        self.assertEqual(there.read_bytes(), keys.read_bytes())
        others = self.make_keys() / "car.keys"
        second = self.install("--keys", others).stdout
        self.assertIn("replace  /etc/pitwall/car.keys", second)
        self.assertEqual(there.read_bytes(), others.read_bytes())
        for text in (keys.read_text(), others.read_text()):
            for key in re.findall(r"\b[0-9a-f]{64}\b", text):
                self.assertNotIn(key, first + second)
        self.assertNotIn("no keys", second)
        credential = unit_files.read(self.text(UNIT))["Service", "LoadCredential"]
        self.assertEqual(credential, ["car.keys:/etc/pitwall/car.keys"])

    def test_keys_stay_when_none_are_brought_and_go_with_an_uninstall(self):
        self.install("--keys", self.make_keys() / "car.keys")
        before = snapshot(self.root)
        self.install()
        self.assertEqual(snapshot(self.root), before)
        self.install("--uninstall")
        self.assertEqual(snapshot(self.root), {})

    def test_an_installation_without_keys_says_so(self):
        self.assertRegex(self.install().stdout, r"(?m)^note +no keys for the radio yet")

    def test_the_keys_of_the_pit_wall_are_not_the_cars(self):
        said = self.install("--keys", self.make_keys() / "base.keys", expect=2).stderr
        self.assertIn("role: car", said)
        self.assertEqual(snapshot(self.root), {})

    def test_keys_of_a_bench_are_for_no_car(self):
        folder = Path(tempfile.mkdtemp(dir=self.root.parent))
        self.run_installer("keygen", "--bench", "--out", folder / "keys",
                           program=BUILD / "basestation/pitwall-base")
        said = self.install("--keys", folder / "keys/car.keys", expect=2).stderr
        self.assertIn("for a bench", said)
        self.assertEqual(snapshot(self.root), {})

    def test_the_guardian_accepts_its_unit_and_shares_the_record_of_the_car_process(self):
        self.install()
        program, *arguments = self.command_of(GUARDIAN_UNIT)
        self.run_installer(*arguments, "--check", program=program)
        car = self.command_of(UNIT)
        for option in ("--guardian", "--can", "--car"):
            self.assertEqual(arguments[arguments.index(option) + 1], car[car.index(option) + 1])
        own, of_car = ({word[2:] for word in words if re.match("[01]=", word)}
                       for words in (arguments, car))
        self.assertEqual((len(own), len(of_car)), (2, 2))
        self.assertFalse(own & of_car, "two processes cannot have one port")

    def test_the_guardian_never_has_a_port_of_the_car_process(self):
        for links in [("--gnss", "4000,4001", "--guardian-gnss", "4001,4002"),
                      ("--receiver", "0=tcp:10.0.0.9:3001", "--guardian-receiver",
                       "1=tcp:10.0.0.9:3001"),
                      ("--receiver", "0=serial:/dev/ttyS0:460800", "--guardian-receiver",
                       "0=serial:/dev/ttyS0")]:
            self.assertIn("--guardian-gnss", self.install(*links, expect=2).stderr)
        self.assertEqual(snapshot(self.root), {})

    # --- receivers that are not on UDP

    def test_receivers_over_tcp_and_a_serial_line(self):
        """The links of the example in docs/your_car.md, and the device that the unit may open."""
        page = (SOURCE / "docs/your_car.md").read_text()
        example = re.search(r"`((?:--receiver \S+ ?){2})`", page)[1]
        self.assertIn("=tcp:", example)
        device = re.search(r"serial:(/dev/\w+)", example)[1]
        self.install(*example.split(), "--keys", self.make_keys() / "car.keys")
        program, *arguments = self.command_of(UNIT)
        for word in example.split():
            self.assertIn(word, arguments)
        self.run_installer(*arguments, "--check", program=program)
        serial = unit_files.read(self.text(UNIT + ".d/serial.conf"))["Service", "DeviceAllow"]
        self.assertEqual(serial, [f"{device} rw"])
        self.assertEqual(unit_files.unknown_keys(self.root), [])
        self.assertFalse((self.root / (GUARDIAN_UNIT + ".d")).exists(), "it has no serial line")
        self.install()  # back on UDP
        self.assertFalse((self.root / (UNIT + ".d")).exists())

    def test_a_crashing_process_stays_down(self):
        self.install()
        unit = unit_files.read(self.text(UNIT))
        self.assertEqual(unit["Service", "Restart"], ["on-failure"])
        burst = int(unit["Unit", "StartLimitBurst"][0])
        interval_s = int(unit["Unit", "StartLimitIntervalSec"][0])
        self.assertLess(burst * (int(unit["Service", "RestartSec"][0]) + 1), interval_s)
        self.assertIn("2", unit["Service", "RestartPreventExitStatus"])

    def test_the_unit_has_one_capability_and_the_limits_that_the_program_asks_for(self):
        self.install()
        unit = unit_files.read(self.text(UNIT))
        for key in ("AmbientCapabilities", "CapabilityBoundingSet"):
            self.assertEqual(unit["Service", key], ["CAP_NET_ADMIN"])
        for path, main in ((UNIT, "vehicle/main.cpp"),
                           (GUARDIAN_UNIT, "vehicle/guardian/main.cpp")):
            priority = int(re.search(r"kPriority = (\d+)", (SOURCE / main).read_text())[1])
            limit = unit_files.read(self.text(path))["Service", "LimitRTPRIO"][0]
            self.assertGreaterEqual(int(limit), priority)
        self.assertEqual(unit["Service", "LimitMEMLOCK"], ["infinity"])
        self.assertEqual(unit["Service", "User"], ["pitwall"])
        self.assertRegex(self.text("etc/sysusers.d/pitwall.conf"), r"(?m)^u pitwall ")

    def test_the_receive_buffer_is_the_one_that_the_socket_asks_for(self):
        self.install()
        socket = (SOURCE / "protocol/transport/can/can_socket.hpp").read_text()
        factor, shift = re.search(r"receive_buffer_bytes = (\d+) << (\d+)", socket).groups()
        self.assertIn(f"net.core.rmem_max = {int(factor) << int(shift)}\n",
                      self.text("etc/sysctl.d/05-pitwall.conf"))

    def test_the_bus_is_set_up_as_asked(self):
        self.install("--can", "kvaser1", "--bitrate", "1000000", "--restart-ms", "0",
                     "--listen-only")
        network = unit_files.read(self.text(NETWORK.replace("can0", "kvaser1")))
        self.assertEqual(network["Match", "Name"], ["kvaser1"])
        self.assertEqual(network["CAN", "BitRate"], ["1000000"])
        self.assertEqual(network["CAN", "RestartSec"], ["0ms"])
        self.assertEqual(network["CAN", "ListenOnly"], ["yes"])
        unit = unit_files.read(self.text(UNIT))
        self.assertEqual(unit["Unit", "BindsTo"],
                         ["sys-subsystem-net-devices-kvaser1.device"])
        self.assertIn("--can kvaser1 ", unit["Service", "ExecStart"][0])

    def test_systemd_252_knows_every_key(self):
        self.install()
        self.assertEqual(unit_files.unknown_keys(self.root), [])
        self.with_network_manager()
        self.install("--can", "can1")
        self.assertTrue((self.root / "etc/systemd/system/pitwall-can-can1.service").exists())
        self.assertEqual(unit_files.unknown_keys(self.root), [])
        (self.root / UNIT).write_text(self.text(UNIT).replace("ProtectHome", "ProtectHorne"))
        self.assertEqual(unit_files.unknown_keys(self.root), ["Service.ProtectHorne"])

    def test_systemd_itself_has_nothing_to_say(self):
        self.install()
        self.ask_systemd(UNIT)
        self.ask_systemd(GUARDIAN_UNIT)

    def test_systemd_itself_has_nothing_to_say_of_the_unit_for_the_bus(self):
        self.with_network_manager()
        self.install()
        self.ask_systemd("etc/systemd/system/pitwall-can-can0.service")

    def ask_systemd(self, path):
        if not shutil.which("systemd-analyze"):
            print(f"SKIPPED: no systemd-analyze here; the keys of {path} were checked by list")
            return
        copy = self.root.parent / Path(path).name
        programs = self.root.parent / "programs"  # systemd wants no blanks in a program's path
        if not programs.is_symlink():
            programs.symlink_to(self.root / "opt/pitwall")
        copy.write_text(self.text(path).replace("/opt/pitwall", str(programs)))
        said = subprocess.run(["systemd-analyze", "verify", "--man=no", copy], text=True,
                              capture_output=True)
        about_us = [line for line in said.stderr.splitlines() if copy.name in line]
        self.assertEqual((said.returncode, about_us), (0, []), said.stderr)

    # --- who manages the network

    def with_network_manager(self):
        link = self.root / NETWORKD.replace("systemd-networkd", "NetworkManager")
        link.parent.mkdir(parents=True, exist_ok=True)
        link.symlink_to("/lib/systemd/system/NetworkManager.service")

    def expect_own_unit(self, manager):
        out = self.install("--listen-only").stdout
        self.assertRegex(out, rf"note .*{manager}.*systemd-networkd is not enabled")
        self.assertFalse(os.path.lexists(self.root / NETWORKD))
        self.assertFalse((self.root / NETWORK).exists())
        unit = unit_files.read(self.text("etc/systemd/system/pitwall-can-can0.service"))
        self.assertIn("/sbin/ip link set can0 type can bitrate 500000 restart-ms 0 "
                      "listen-only on", unit["Service", "ExecStart"])
        wanted = self.root / "etc/systemd/system/sys-subsystem-net-devices-can0.device.wants"
        self.assertEqual({link.name for link in wanted.iterdir()},
                         {"pitwall-can-can0.service", "pitwall-guardian.service",
                          "pitwall-vehicle.service"})

    def test_under_network_manager_a_unit_of_our_own_sets_the_bus_up(self):
        self.with_network_manager()
        self.expect_own_unit("NetworkManager")

    def test_under_ifupdown_a_unit_of_our_own_sets_the_bus_up(self):
        self.write("etc/network/interfaces", "auto lo\niface lo inet loopback\n"
                                             "allow-hotplug enp1s0\niface enp1s0 inet dhcp\n")
        self.expect_own_unit("ifupdown")

    def test_ifupdown_with_nothing_but_loopback_manages_nothing(self):
        self.write("etc/network/interfaces", "auto lo\niface lo inet loopback\n")
        self.install()
        self.assertTrue(os.path.lexists(self.root / NETWORKD))

    def test_an_enabled_networkd_is_used_and_is_not_ours_to_remove(self):
        self.with_network_manager()
        (self.root / NETWORKD).symlink_to("/lib/systemd/system/systemd-networkd.service")
        self.install()
        self.assertTrue((self.root / NETWORK).exists())
        self.install("--uninstall")
        self.assertTrue(os.path.lexists(self.root / NETWORKD))

    def test_others_that_set_the_same_interface_up_are_named(self):
        self.write("etc/network/interfaces", "iface can0 inet manual\n")
        self.write("etc/systemd/network/20-team.network", "[Match]\nName=can*\n[CAN]\nBitRate=1M\n")
        out = self.install("--dry-run").stdout
        self.assertIn("/etc/network/interfaces sets up can0 too", out)
        self.assertIn("/etc/systemd/network/20-team.network sets up CAN too", out)

    # --- once more, edited, and gone again

    def test_a_second_installation_keeps_everything(self):
        self.install()
        before = snapshot(self.root)
        again = self.install().stdout
        actions = {line.split()[0] for line in again.splitlines()}
        self.assertEqual(actions - {"note"}, {"keep"})
        self.assertEqual(snapshot(self.root), before)

    def test_edited_configuration_stays_and_a_new_version_goes_beside_it(self):
        self.install()
        edited = self.write(ENVIRONMENT, self.text(ENVIRONMENT) + "# by hand\n").read_text()
        self.assertEqual(lines_of(self.install().stdout, "create"), [])  # nothing new to say
        out = self.install("--radio", "10.42.0.1:23431").stdout
        self.assertIn("vehicle.env was edited here", out)
        self.assertEqual(self.text(ENVIRONMENT), edited)
        self.assertIn("PITWALL_RADIO=10.42.0.1:23431\n", self.text(ENVIRONMENT + ".new"))
        self.install("--uninstall")
        left = {path: about[2] for path, about in snapshot(self.root).items() if about[2]}
        self.assertEqual(left, {ENVIRONMENT: edited.encode()})

    def test_a_configuration_file_of_somebody_else_is_never_touched(self):
        own = self.write("etc/pitwall/cars/av21.yaml", "mine\n")
        self.install()
        self.assertEqual(own.read_text(), "mine\n")
        self.assertTrue(Path(f"{own}.new").exists())
        self.install("--uninstall")
        self.assertEqual(own.read_text(), "mine\n")

    def test_another_interface_takes_the_place_of_the_first(self):
        self.install()
        self.install("--can", "can1")
        left = [path for path in snapshot(self.root) if "can0" in path]
        self.assertEqual(left, [])
        self.assertNotIn("can0", self.text(UNIT))

    def test_a_track_that_is_no_longer_chosen_stays(self):
        self.install()
        self.install("--track", SOURCE / "vehicle/config/tracks/ims.yaml")
        self.assertTrue((self.root / "etc/pitwall/tracks/lvms.yaml").exists())
        self.install("--uninstall")
        self.assertEqual(snapshot(self.root), {})

    def test_an_uninstall_leaves_what_was_there_before(self):
        self.write("etc/sysctl.d/99-team.conf", "net.core.rmem_max = 1\n")
        self.write("etc/systemd/network/20-eth.network", "[Match]\nName=e*\n")
        self.write("var/lib/pitwall/vehicle/summary.json", "{}\n")
        before = snapshot(self.root)
        self.install("--bitrate", "250000")
        self.install("--radio", "10.42.0.1:23431", "--listen-only")
        self.install("--uninstall")
        self.assertEqual(snapshot(self.root), before)

    def test_an_uninstall_says_beforehand_what_it_removes(self):
        self.install()
        before = snapshot(self.root)
        plan = self.install("--uninstall", "--dry-run").stdout
        self.assertEqual(snapshot(self.root), before)
        self.assertEqual(self.install("--uninstall").stdout, plan)
        self.assertEqual(snapshot(self.root), {})
        self.assertIn("nothing of ours", self.install("--uninstall", expect=1).stderr)

    # --- when it goes wrong

    def test_a_full_disk_leaves_no_trace(self):
        self.write("etc/hostname", "car\n")
        before = snapshot(self.root)

        def small_disk():
            size = MORE_THAN_A_TEXT_LESS_THAN_A_PROGRAM
            resource.setrlimit(resource.RLIMIT_FSIZE, (size, size))

        self.assertIn("as it was", self.install(expect=1, preexec_fn=small_disk).stderr)
        self.assertEqual(snapshot(self.root), before)

    def test_a_failure_half_way_puts_every_file_back(self):
        self.install()
        # The old file has nowhere to wait: the swap of this one fails, after that of the network.
        (self.root / (UNIT + ".pitwall-old")).mkdir()
        before = snapshot(self.root)
        change = ("--can", "can1", "--radio", "10.42.0.1:23431")
        out = self.install(*change, expect=1)
        self.assertIn("create   /etc/systemd/network/70-pitwall-can1.network", out.stdout)
        self.assertIn("as it was", out.stderr)
        self.assertEqual(snapshot(self.root), before)

    def test_something_else_in_the_way_is_named_and_nothing_is_changed(self):
        (self.root / UNIT).mkdir(parents=True)
        self.write("opt", "a file\n")
        before = snapshot(self.root)
        self.assertIn("/opt is in the way", self.install(expect=1).stderr)
        (self.root / "opt").unlink()
        self.assertIn(f"{UNIT} is in the way", self.install(expect=1).stderr)
        del before["opt"]
        self.assertEqual(snapshot(self.root), before)

    def test_a_damaged_manifest_removes_nothing(self):
        self.install()
        for path in ("/etc/passwd", "/opt/pitwall/../../etc/passwd", "/etc/systemd/system/x"):
            victim = self.write(path.lstrip("/"), "root\n")
            manifest = self.root / MANIFEST
            good = manifest.read_text()
            manifest.write_text(f"{good}system\t0\t{path}\n")
            before = snapshot(self.root)
            self.assertIn("install.manifest:", self.install("--uninstall", expect=1).stderr)
            self.assertEqual(snapshot(self.root), before)
            manifest.write_text(good)
            self.assertTrue(victim.exists())

    def test_programs_that_are_not_built_are_named(self):
        empty = self.root.parent / "empty"
        empty.mkdir()
        self.assertIn("not built yet", self.install("--build", empty, "--dry-run").stdout)
        self.assertIn("not built", self.install("--build", empty, expect=1).stderr)
        self.assertEqual(snapshot(self.root), {})


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[3:])

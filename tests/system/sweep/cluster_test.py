#!/usr/bin/python3
"""Sweeps on a cluster, as a user has them: what it yields is what this machine alone yields.

usage  cluster_test.py PITWALL_HIL, from the root of the tree
SPDX-License-Identifier: Apache-2.0
"""
import json
import pathlib
import signal
import subprocess
import sys
import tempfile
import time
import unittest

from cluster import Cluster

HIL = sys.argv.pop(1)
CASES = 16

PLAN = f"""schema: 1
name: cluster
scenario: hil/scenarios/launch.yaml
seed: 5
combine: draw
cases: {CASES}
parameters:
  - {{path: duration_s, values: [20]}}
  - {{path: perturb.friction, from: 0.8, to: 1.1}}
  - {{path: "expect[0].value", values: [0.5, 100]}}   # of the wall's gap: half of them fail
"""


class OnACluster(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory(prefix="pitwall-cluster-")
        cls.folder = pathlib.Path(cls.temporary.name)
        cls.plan = cls.folder / "plan.yaml"
        cls.plan.write_text(PLAN)
        local = cls.run_sweep("local")
        assert local.returncode == 1, local.stdout
        cls.expected = cls.results("local")

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    def setUp(self):
        self.cluster = Cluster()
        self.addCleanup(self.cluster.stop)

    @classmethod
    def command(cls, name, *more):
        return [HIL, "sweep", str(cls.plan), "--out", str(cls.folder / name), *more]

    @classmethod
    def run_sweep(cls, name, *more, environment=None):
        return subprocess.run(cls.command(name, *more), env=environment, text=True,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT)  # fmt: skip

    @classmethod
    def results(cls, name):
        return (cls.folder / name / "results.sqlite").read_bytes()

    def lines(self, name):
        files = (self.folder / name / "cases").glob("*.jsonl")
        return [json.loads(line) for file in files for line in file.read_text().splitlines()]

    def started(self, name):
        return subprocess.Popen(self.command(name, "--engine", "slurm"), text=True,
                                env=self.cluster.environment(), stdout=subprocess.PIPE,
                                stderr=subprocess.STDOUT)  # fmt: skip

    def until(self, what, is_so):
        for _ in range(600):
            if is_so():
                return
            time.sleep(0.1)
        self.fail(f"waited 60 s in vain for {what}: {self.cluster.said('squeue', '--array')}")

    def test_a_node_that_is_killed_in_the_middle_changes_nothing(self):
        sweep = self.started("killed")
        self.until("some results", lambda: len(self.lines("killed")) >= 4)
        self.cluster.kill_node("car2")
        said, _ = sweep.communicate(timeout=240)
        self.assertEqual(sweep.returncode, 1, said)
        self.assertEqual(self.results("killed"), self.expected, said)
        self.assertNotEqual(self.cluster.said("sinfo", "-h", "-n", "car2", "-o", "%t"), "idle")

    def test_what_is_interrupted_and_resumed_is_run_once(self):
        sweep = self.started("resumed")
        self.until("some results", lambda: len(self.lines("resumed")) >= 3)
        sweep.send_signal(signal.SIGKILL)
        sweep.communicate()
        again = self.run_sweep("resumed", "--engine", "slurm",
                               environment=self.cluster.environment())  # fmt: skip
        self.assertEqual(again.returncode, 1, again.stdout)
        self.assertEqual(self.results("resumed"), self.expected, again.stdout)
        numbers = sorted(line["case"] for line in self.lines("resumed"))
        self.assertEqual(numbers, list(range(CASES)), "each case once")

    def test_a_job_that_is_held_is_told_and_not_waited_for(self):
        held = self.run_sweep("held", "--engine", "slurm", "--sbatch=--hold",
                              environment=self.cluster.environment())  # fmt: skip
        self.assertEqual(held.returncode, 2, held.stdout)
        self.assertIn("every task that is left is held: JobHeldUser", held.stdout)

    def test_an_option_that_sbatch_does_not_take_is_told(self):
        refused = self.run_sweep("refused", "--engine", "slurm", "--sbatch=--partition=none",
                                 environment=self.cluster.environment())  # fmt: skip
        self.assertEqual(refused.returncode, 2, refused.stdout)
        self.assertIn("sbatch: error", refused.stdout)
        self.assertIn("invalid partition", refused.stdout)


if __name__ == "__main__":
    unittest.main(verbosity=2)

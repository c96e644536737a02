#!/usr/bin/env python3
"""Checks what run.py is made of, without the programs it measures: `python3 benches/peers/check.py`."""

import pathlib
import sys
import unittest

import environment
import run
from protocol import Child, allowed_cpus
from results import Row, Target, table, verdicts

SERVER = "from protocol import serve; serve({'add': lambda a, b: [float(a) + float(b)], 'hush': lambda: None})"


class Check(unittest.TestCase):
    def row(self, **more):
        given = {"job": "job", "peer": "peer", "threads": 1, "state": "warm", "ours": [2.0, 9.0, 3.0]}
        return Row(**{**given, "theirs": [9.0, 9.0, 8.0], "items": 3, **more})

    def test_ratios_are_of_medians(self):
        self.assertEqual(self.row().ratio, 3.0)
        self.assertEqual(self.row().ours_ns, 1.0)

    def test_targets_bound_speed_and_cost(self):
        rows = [self.row(), self.row(threads=4, theirs=[1.5])]
        place, other = ("job", "peer", True, "warm"), ("job", "peer", False, "warm")
        cases = [(place, 3, "faster", True), (place, 3.1, "faster", False), (other, 2, "cost", True)]
        for where, wanted, kind, met in [*cases, (other, 1.9, "cost", False)]:
            self.assertIs(Target("", where, wanted, kind).judge(rows)["met"], met)
        self.assertIsNone(Target("", ("none", "peer", True, "warm"), 1, "cost").judge(rows)["met"])

    def test_text_holds_every_row_and_verdict(self):
        row = self.row(difference=0.5, unit="codes")
        self.assertIn("0.5 codes", table([row]).splitlines()[1])
        lines = verdicts([target.judge([row]) for target in run.TARGETS]).splitlines()
        self.assertEqual(len(lines), 1 + len(run.TARGETS))
        self.assertTrue(lines[1].endswith("not measured"))

    def test_children_answer_and_say_what_is_wrong(self):
        here = {"PYTHONPATH": str(environment.HERE)}
        with Child("adder", [sys.executable, "-c", SERVER], allowed_cpus(), here) as child:
            self.assertEqual(child.ask("add", 1, 2.5), [3.5])
            self.assertEqual(child.ask("hush"), [])
            with self.assertRaisesRegex(RuntimeError, "adder: 'add 1 x': ValueError"):
                child.ask("add", 1, "x")
            self.assertEqual(child.ask("add", 1, 1), [2.0], "goes on after a mistake")

    def test_every_requirement_is_pinned(self):
        lines = pathlib.Path(environment.HERE, "requirements.txt").read_text(encoding="utf-8").splitlines()
        for line in (line for line in lines if not line.startswith("#")):
            self.assertRegex(line, r"^[a-z0-9-]+==[0-9.]+$")


if __name__ == "__main__":
    unittest.main()

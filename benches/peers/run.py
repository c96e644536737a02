#!/usr/bin/env python3
"""Runs OpenColorIO and spectral-film-lut beside ours: same machine, same numbers, turn by turn. README.md says how.

Prints a table and the targets; writes target/onelight/peers.json.
"""

import argparse
import datetime
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import time

import environment
import results
from protocol import Child, allowed_cpus
from results import Row, Target

OCIO, FILM_LUT, COPY, PLAIN = "OpenColorIO", "spectral-film-lut", "copy of the f32 picture", "our plain, f32 to f32"
FILMR, DIRECT_U8 = "filmr", "direct, f32 to u8"
PLAIN_F32, PLAIN_U8 = "plain, f32 to f32", "plain, f32 to u8"
STRUCTURED, DISPLAY = "structured, f32 to f32", "structured of display entries, f32 to f32"
DIRECT = "direct, f32 to f32"
# The same with layers that do not inhibit each other.
STRUCTURED_ALONE, DIRECT_ALONE = "structured without inter-image, f32 to f32", "direct without inter-image, f32 to f32"
BAKE, BAKE_FORM, BAKE_EXACT = "bake 33^3", "bake 33^3, its form made before", "bake 33^3, reference"
FILE = "bake 33^3 to .cube"
TARGETS = [
    Target("plain f32 to f32, one thread, times OpenColorIO", (PLAIN_F32, OCIO, True, "warm"), 2.2, "faster"),
    Target("plain f32 to RGBA8, one thread, times OpenColorIO", (PLAIN_U8, OCIO, True, "warm"), 3, "faster"),
    Target("plain f32 to RGBA8, all cores, in copies", (PLAIN_U8, COPY, False, "warm"), 1.5, "cost"),
    Target("structured without inter-image, in OpenColorIO's time", (STRUCTURED_ALONE, OCIO, True, "warm"), 1, "cost"),
    Target("direct without inter-image, in OpenColorIO's time", (DIRECT_ALONE, OCIO, True, "warm"), 1.4, "cost"),
    Target("structured with inter-image, in it without", (STRUCTURED, STRUCTURED_ALONE, True, "warm"), 1.15, "cost"),
    Target("direct with inter-image, in it without", (DIRECT, DIRECT_ALONE, True, "warm"), 1.15, "cost"),
    Target("bake 33^3, one thread, times spectral-film-lut", (BAKE_FORM, FILM_LUT, True, "warm"), 10, "faster"),
    Target("whole process to .cube, times spectral-film-lut", (FILE, FILM_LUT, False, "process"), 70, "faster"),
]
PLAIN_JOBS = {"f32": PLAIN_F32, "u8": PLAIN_U8}
# What the difference of two results may be: the same numbers, rounded in two orders.
TOLERANCE = {"f32": (2e-4, ""), "u8": (1, "codes")}
BAKE_SIZE = 33
# Longest that one comparison goes on, in seconds, but three turns at least.
PATIENCE = 8.0


class Run:
    def __init__(self, arguments, folder):
        self.folder = folder
        self.width, self.height = (960, 540) if arguments.quick else (3840, 2160)
        self.level = arguments.level
        self.rounds = 3 if arguments.quick else 15
        self.fresh = 1 if arguments.quick else 3
        self.cpus = allowed_cpus()
        self.rows = []
        self.notes = []
        self.faults = []
        self.begin = time.monotonic()
        self.peer, self.xtask = environment.programs()
        self.filmr = environment.filmr() if arguments.filmr else None
        self.python = environment.python()

    def say(self, sentence):
        print(f"[{time.monotonic() - self.begin:5.0f} s] {sentence}", file=sys.stderr, flush=True)

    def cpus_for(self, threads):
        return self.cpus[-1:] if threads == 1 else self.cpus

    def ours(self, threads):
        child = Child("onelight", [self.peer], self.cpus_for(threads))
        child.ask("threads", threads)
        if self.level:
            child.ask("level", self.level)
        return child

    def opencolorio(self, threads):
        child = Child(OCIO, [self.python, str(environment.HERE / "opencolorio_peer.py")], self.cpus_for(threads))
        child.ask("threads", threads)
        return child

    def film_lut(self, threads):
        counts = ["NUMBA_NUM_THREADS", "OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"]
        command = [self.python, str(environment.HERE / "film_lut_peer.py")]
        return Child(FILM_LUT, command, self.cpus_for(threads), {name: str(threads) for name in counts})

    def read(self, child, *more):
        child.ask("read", self.folder, self.width, self.height, *more)

    def turns(self, ours, theirs, rounds=None):
        """Times of both, turn by turn: ours, theirs, ours, theirs ..."""
        a, b = [], []
        end = time.monotonic() + PATIENCE
        while len(a) < 3 or (len(a) < (rounds or self.rounds) and time.monotonic() < end):
            a += ours()
            b += theirs()
        return a, b

    def add(self, *row, **more):
        self.rows.append(Row(*row, **more))
        self.say(f"{results.table(self.rows[-1:]).splitlines()[1]}")

    # Pictures.

    def pictures(self, threads):
        pixels = self.width * self.height
        self.say(f"pictures of {self.width}x{self.height}, {threads} threads")
        with self.ours(threads) as ours, self.opencolorio(threads) as theirs:
            self.read(ours)
            self.read(theirs, *self.shaper)
            ours.ask("build", "plain")
            apply = lambda form, kind: lambda: ours.ask("apply", form, kind, 1)
            for kind in ["f32", "u8"]:
                theirs.ask("build", kind)
                apply("plain", kind)()
                theirs.ask("apply", kind, 1)
                times = self.turns(apply("plain", kind), lambda: theirs.ask("apply", kind, 1))
                result = self.folder / f"ours.{kind}"
                ours.ask("save", kind, result)
                (difference,) = theirs.ask("compare", kind, result)
                result.unlink()
                tolerance, unit = TOLERANCE[kind]
                if not difference <= tolerance:
                    self.faults.append(f"{PLAIN_JOBS[kind]}: differs by {difference:g}, expected at most {tolerance:g}")
                self.add(PLAIN_JOBS[kind], OCIO, threads, "warm", *times, pixels, difference, unit)
            copy = lambda: ours.ask("copy", 1)
            for kind in ["f32", "u8"]:
                copy()
                self.add(PLAIN_JOBS[kind], COPY, threads, "warm", *self.turns(apply("plain", kind), copy), pixels)
            theirs.ask("build", "f32")
            forms = [("structured", STRUCTURED), ("display", DISPLAY), ("direct", DIRECT)]
            alone = [("structured-uncoupled", STRUCTURED_ALONE), ("direct-uncoupled", DIRECT_ALONE)]
            for form, job in forms + alone:
                self.say(f"making the {form} form")
                ours.ask("build", form)
                apply(form, "f32")()
                times = self.turns(apply(form, "f32"), apply("plain", "f32"))
                self.add(job, PLAIN, threads, "warm", *times, pixels)
            for form, job in alone:
                times = self.turns(apply(form, "f32"), lambda: theirs.ask("apply", "f32", 1))
                self.add(job, OCIO, threads, "warm", *times, pixels)
            for (form, job), (without, job_without) in [(forms[0], alone[0]), (forms[2], alone[1])]:
                times = self.turns(apply(form, "f32"), apply(without, "f32"))
                self.add(job, job_without, threads, "warm", *times, pixels)

    def filmr_pictures(self, threads):
        """A whole film of filmr's, its random and spatial effects off as far as it has switches, beside ours."""
        if self.filmr is None:
            return
        with self.ours(threads) as ours, Child(FILMR, [self.filmr], self.cpus_for(threads)) as theirs:
            theirs.ask("threads", threads)
            self.read(ours)
            self.read(theirs)
            ours.ask("build", "direct")
            ours.ask("apply", "direct", "u8", 1)
            times = self.turns(lambda: ours.ask("apply", "direct", "u8", 1), lambda: theirs.ask("apply", 1), 3)
            self.add(DIRECT_U8, FILMR, threads, "warm", *times, self.width * self.height)

    def cold_pictures(self, threads):
        for kind in ["f32", "u8"]:
            a, b = [], []
            for _ in range(self.fresh):
                with self.ours(threads) as ours:
                    self.read(ours)
                    a.append(sum(ours.ask("build", "plain") + ours.ask("apply", "plain", kind, 1)))
                with self.opencolorio(threads) as theirs:
                    self.read(theirs, *self.shaper)
                    b.append(sum(theirs.ask("build", kind) + theirs.ask("apply", kind, 1)))
            self.add(PLAIN_JOBS[kind], OCIO, threads, "cold", a, b, self.width * self.height)

    # Tables.

    def bakes(self, threads):
        self.say(f"tables of {BAKE_SIZE}^3, {threads} threads; {FILM_LUT} takes its time to begin")
        nodes = BAKE_SIZE**3
        with self.ours(threads) as ours, self.film_lut(threads) as theirs:
            # From nothing to a first table, in these two new processes.
            a = [sum(ours.ask("compile", 1) + ours.ask("bake", "usual", BAKE_SIZE, 1))]
            b = [sum(theirs.ask("compile") + theirs.ask("bake", BAKE_SIZE, 1))]
            self.add("compile and " + BAKE, FILM_LUT, threads, "cold", a, b, nodes)
            for way, job in [("form", BAKE_FORM), ("usual", BAKE), ("reference", BAKE_EXACT)]:
                ours.ask("bake", way, BAKE_SIZE, 1)
                times = self.turns(
                    lambda: ours.ask("bake", way, BAKE_SIZE, 1), lambda: theirs.ask("bake", BAKE_SIZE, 1), 7
                )
                (worst,) = ours.ask("misses", way, BAKE_SIZE)
                self.add(job, FILM_LUT, threads, "warm", *times, nodes, worst, "dE, node")
            together = lambda: [sum(ours.ask("compile", 1) + ours.ask("bake", "usual", BAKE_SIZE, 1))]
            times = self.turns(together, lambda: theirs.ask("bake", BAKE_SIZE, 1), 5)
            self.add("compile and " + BAKE, FILM_LUT, threads, "warm", *times, nodes)

    def processes(self):
        self.say("whole processes, from the command to the file")
        options = subprocess.run([self.xtask, "bake", "--help"], stdout=subprocess.PIPE, text=True, check=True).stdout
        quick = ["--quick"] if "--quick" in options else []
        if not quick:
            self.notes.append("bake has no --quick here: the usual bake, which certifies and draws a preview too")
        out = self.folder / "bake"
        ours = [self.xtask, "bake", *quick, "--size", str(BAKE_SIZE), "--out", str(out)]
        file = self.folder / "theirs.cube"
        theirs = [self.python, str(environment.HERE / "film_lut_peer.py"), str(file), str(BAKE_SIZE)]
        a, b = [], []
        for _ in range(self.fresh):
            a.append(self.seconds(ours, out / "look.scene-linear.resolve.cube"))
            b.append(self.seconds(theirs, file))
        self.add(FILE, FILM_LUT, len(self.cpus), "process", a, b, BAKE_SIZE**3)

    def seconds(self, command, file):
        """Nanoseconds of a program that writes a file."""
        file.unlink(missing_ok=True)
        begin = time.perf_counter_ns()
        done = subprocess.run(command, cwd=environment.TOP, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        end = time.perf_counter_ns()
        if done.returncode or not file.exists():
            raise RuntimeError(f"{' '.join(command)}: wrote no {file.name}: {done.stdout.strip()[-300:]}")
        return float(end - begin)

    def all(self):
        with Child("onelight", [self.peer], self.cpus) as ours:
            self.shaper = ours.ask("make", self.folder, self.width, self.height)
        for threads in sorted({1, len(self.cpus)}):
            self.pictures(threads)
            self.filmr_pictures(threads)
            self.cold_pictures(threads)
            self.bakes(threads)
        self.processes()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quick", action="store_true", help="a small picture, few turns: whether it runs")
    help = "the vector instructions that ours has to do with, such as AVX2; the best of the machine if not given"
    parser.add_argument("--level", metavar="NAME", help=help)
    parser.add_argument("--filmr", action="store_true", help="filmr too, which is compiled for it (minutes)")
    arguments = parser.parse_args()

    # Before building, which loads the machine itself.
    load = list(os.getloadavg()) if hasattr(os, "getloadavg") else None
    environment.OUTPUT.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(dir=environment.OUTPUT, prefix="peers-") as folder:
        run = Run(arguments, pathlib.Path(folder))
        report = {
            "date": datetime.datetime.now(datetime.timezone.utc).isoformat(timespec="seconds"),
            "machine": environment.machine(run.cpus),
            "versions": environment.versions(run.python),
            "quick": arguments.quick,
            "level": arguments.level,
            "picture": {"width": run.width, "height": run.height, "channels": "RGBA"},
        }
        run.all()
    judged = [target.judge(run.rows) for target in TARGETS]
    notes = run.notes + run.faults
    report |= {"load_before": load, "rows": [row.json() for row in run.rows], "targets": judged, "notes": notes}
    path = environment.OUTPUT / "peers.json"
    path.write_text(json.dumps(report, indent=2) + "\n", encoding="utf-8")

    machine, versions = report["machine"], ", ".join(f"{name} {v}" for name, v in report["versions"].items())
    print(f"{machine['cpu']}, {machine['cores']} cores; {report['date']}\n{versions}")
    if load and load[0] > 0.5:
        print(f"Other programs were running: load {load[0]:.1f} before the first turn.")
    level = f"; ours by {run.level}" if run.level else ""
    print(f"{run.width}x{run.height} RGBA, medians of turns{level}\n\n{results.table(run.rows)}\n\n{results.verdicts(judged)}")
    for note in notes:
        print(f"note: {note}")
    print(f"\n{path.relative_to(environment.TOP)}")
    return 1 if run.faults else 0


if __name__ == "__main__":
    sys.exit(main())

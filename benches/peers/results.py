"""Rows of figures, what they should reach, and both as text and as JSON."""

import dataclasses
import statistics
import typing


@dataclasses.dataclass
class Row:
    """One job of ours beside another program's, or beside another job of ours."""

    job: str
    peer: str
    threads: int
    # "warm": done before in the same process. "cold": for the first time in a new process, from the table's numbers or
    # the films on. "process": a whole program, from its start to its end.
    state: str
    ours: typing.List[float]
    theirs: typing.List[float]
    # Pixels, or nodes of the table.
    items: int
    # Largest difference of the results, and what it is counted in.
    difference: typing.Optional[float] = None
    unit: str = ""

    @property
    def ours_ns(self):
        return statistics.median(self.ours) / self.items

    @property
    def theirs_ns(self):
        return statistics.median(self.theirs) / self.items

    @property
    def ratio(self):
        """How many times the other takes of our time."""
        return self.theirs_ns / self.ours_ns

    def json(self):
        return {
            "job": self.job,
            "peer": self.peer,
            "threads": self.threads,
            "state": self.state,
            "ours_ns_per_pixel": self.ours_ns,
            "theirs_ns_per_pixel": self.theirs_ns,
            "ratio": self.ratio,
            "ours_best_ns_per_pixel": min(self.ours) / self.items,
            "theirs_best_ns_per_pixel": min(self.theirs) / self.items,
            "ours_ms": statistics.median(self.ours) / 1e6,
            "theirs_ms": statistics.median(self.theirs) / 1e6,
            "pixels": self.items,
            "rounds": len(self.ours),
            "difference": self.difference,
            "difference_unit": self.unit or None,
        }

    def differs(self):
        return "" if self.difference is None else f"{self.difference:.2g} {self.unit}"


@dataclasses.dataclass
class Target:
    """What a row should reach."""

    what: str
    # Job, peer, whether on one thread, state.
    row: typing.Tuple[str, str, bool, str]
    wanted: float
    # "faster": so many times as fast as the other at least. "cost": so many times the other's time at most.
    kind: str

    def judge(self, rows):
        """Words for one line, and what JSON says."""
        job, peer, one_thread, state = self.row
        found, met = None, None
        for row in rows:
            if (row.job, row.peer, row.threads == 1, row.state) == (job, peer, one_thread, state):
                found = row.ratio if self.kind == "faster" else 1 / row.ratio
                met = found >= self.wanted if self.kind == "faster" else found <= self.wanted
        return {"target": self.what, "wanted": self.wanted, "kind": self.kind, "found": found, "met": met}


HEADINGS = ["job", "beside", "threads", "state", "ours", "theirs", "theirs / ours", "difference"]


def time(ns, row):
    if row.state == "process":
        return f"{ns * row.items / 1e9:.2f} s"
    # Tables have fewer nodes than any picture here has pixels.
    return f"{ns:.2f} ns/px" if row.items > 1 << 18 else f"{ns * row.items / 1e6:.1f} ms"


def table(rows):
    lines = [HEADINGS]
    for row in rows:
        threads = "-" if row.state == "process" else str(row.threads)
        ours, theirs = time(row.ours_ns, row), time(row.theirs_ns, row)
        lines.append([row.job, row.peer, threads, row.state, ours, theirs, f"{row.ratio:.2f}", row.differs()])
    return columns(lines)


def verdicts(judged):
    lines = [["target", "wanted", "found", ""]]
    for verdict in judged:
        bound = "at least" if verdict["kind"] == "faster" else "at most"
        found = "-" if verdict["found"] is None else f"{verdict['found']:.2f}"
        met = {True: "met", False: "missed", None: "not measured"}[verdict["met"]]
        lines.append([verdict["target"], f"{bound} {verdict['wanted']:g}", found, met])
    return columns(lines)


def columns(lines):
    widths = [max(len(line[i]) for line in lines) for i in range(len(lines[0]))]
    return "\n".join("  ".join(cell.ljust(width) for cell, width in zip(line, widths)).rstrip() for line in lines)

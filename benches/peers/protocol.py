"""How run.py speaks with the programs it measures: lines of words in, `ok` and numbers `error` and a sentence out."""

import os
import subprocess
import sys


def serve(commands):
    """Answers the standard input until it ends. `commands`: word -> function of the further words, returns numbers."""
    # Whatever a library prints must not get between the answers.
    answers, sys.stdout = sys.stdout, sys.stderr
    for line in sys.stdin:
        try:
            word, *rest = line.split()
            numbers = commands[word](*rest) or ()
            answer = " ".join(["ok", *(repr(float(number)) for number in numbers)])
        except Exception as error:  # One bad command is no reason to stop.
            answer = f"error {line.strip()!r}: {type(error).__name__}: {error}"
        print(answer, file=answers, flush=True)


class Child:
    """A program that answers in this way, held to `cpus` where the system can do that."""

    def __init__(self, name, command, cpus, environment=None):
        self.name = name
        self.process = subprocess.Popen(
            command,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
            env={**os.environ, **(environment or {})},
            preexec_fn=lambda: hold_to(cpus),
        )

    def ask(self, *words):
        """One command; its numbers."""
        try:
            print(*words, file=self.process.stdin, flush=True)
            answer = self.process.stdout.readline()
        except BrokenPipeError:
            answer = ""
        verdict, _, rest = answer.strip().partition(" ")
        if verdict != "ok":
            raise RuntimeError(f"{self.name}: {rest or 'ended without an answer'}")
        return [float(number) for number in rest.split()]

    def end(self):
        self.process.stdin.close()
        self.process.wait()
        self.process.stdout.close()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.end()


def allowed_cpus():
    """Numbers of the processors that this process may use."""
    if hasattr(os, "sched_getaffinity"):
        return sorted(os.sched_getaffinity(0))
    return list(range(os.cpu_count() or 1))


def hold_to(cpus):
    if hasattr(os, "sched_setaffinity"):
        os.sched_setaffinity(0, cpus)

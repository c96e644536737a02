"""What the comparison needs: our release programs, and a Python of its own with the others in it, under target/."""

import json
import pathlib
import platform
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
TOP = HERE.parents[1]
PYTHON = TOP / "target" / "peers"
OUTPUT = TOP / "target" / "onelight"


def programs():
    """Builds our programs; paths of `peer` and `xtask`."""
    found = built(["cargo", "build", "--release", "--bins", "-p", "onelight-benches", "-p", "xtask"])
    return found["peer"], found["xtask"]


def filmr():
    """Builds filmr's side, a package of its own; its path."""
    manifest, target = HERE / "filmr" / "Cargo.toml", TOP / "target" / "filmr"
    command = ["cargo", "build", "--release", "--manifest-path", str(manifest), "--target-dir", str(target)]
    return built(command)["filmr-peer"]


def built(command):
    """Runs a build; names and paths of the programs."""
    done = subprocess.run(
        [*command, "--message-format=json-render-diagnostics"], cwd=TOP, stdout=subprocess.PIPE, text=True
    )
    if done.returncode:
        sys.exit(f"{' '.join(command)}: ended with status {done.returncode}")
    found = {}
    for line in done.stdout.splitlines():
        message = json.loads(line)
        if message.get("executable"):
            found[message["target"]["name"]] = message["executable"]
    return found


def python():
    """The environment's Python, made and filled if it is not there."""
    executable = PYTHON / ("Scripts/python.exe" if platform.system() == "Windows" else "bin/python")
    wanted = (HERE / "requirements.txt").read_text(encoding="utf-8")
    stamp = PYTHON / "requirements.txt"
    if executable.exists() and stamp.exists() and stamp.read_text(encoding="utf-8") == wanted:
        return str(executable)
    attempt([sys.executable, "-m", "venv", "--clear", str(PYTHON)], "the Python environment cannot be made")
    install = [str(executable), "-m", "pip", "install", "--quiet", "--disable-pip-version-check"]
    attempt(
        [*install, "-r", str(HERE / "requirements.txt")],
        "OpenColorIO and spectral-film-lut cannot be installed (that needs Python 3.11 or newer and the network)",
    )
    stamp.write_text(wanted, encoding="utf-8")
    return str(executable)


def attempt(command, sentence):
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    if done.returncode:
        lines = [line for line in done.stdout.strip().splitlines() if line] or [f"status {done.returncode}"]
        sys.exit(f"{sentence}: {lines[-1]}")


def machine(cpus):
    """The processor in words, and how many of them may be used."""
    model = platform.processor() or platform.machine()
    try:
        for line in pathlib.Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines():
            if line.startswith("model name"):
                model = line.partition(":")[2].strip()
                break
    except OSError:
        pass
    return {"cpu": model, "cores": len(cpus), "system": f"{platform.system()} {platform.machine()}"}


def versions(python_path):
    """Of everything that was measured."""
    script = (
        "import importlib.metadata as m, platform, json;"
        "names = ['opencolorio', 'spectral-film-lut', 'numpy', 'numba'];"
        "print(json.dumps({'python': platform.python_version(), **{n: m.version(n) for n in names}}))"
    )
    found = json.loads(output_of([python_path, "-c", script]))
    rustc = output_of(["rustc", "--version"]).strip().removeprefix("rustc ")
    packages = json.loads(output_of(["cargo", "metadata", "--no-deps", "--format-version", "1"]))["packages"]
    ours = next(package["version"] for package in packages if package["name"] == "onelight")
    return {"onelight": ours, "rustc": rustc, **found}


def output_of(command):
    """What a program prints."""
    return subprocess.run(command, cwd=TOP, stdout=subprocess.PIPE, text=True, check=True).stdout

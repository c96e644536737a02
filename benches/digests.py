#!/usr/bin/env python3
"""Do two builds of the program make the same files? For changes of the code that must change no picture.

    cargo build --release -p xtask
    python3 benches/digests.py target/release/xtask > before.json       # in the old checkout
    python3 benches/digests.py target/release/xtask --against before.json   # in the new one

Ten looks are baked in every form and format and the fixture scene is developed in every form; what a command refuses
counts too, with its sentence. The second call lists every file whose bytes differ and ends with status 1 if there is one.
Needs Python 3.9 and nothing else; takes about a minute on two cores.
"""

import argparse
import hashlib
import json
import pathlib
import struct
import subprocess
import sys
import tempfile
import zlib

ROOT = pathlib.Path(__file__).resolve().parent.parent
SCENE = ROOT / "fixtures" / "scene" / "scene.exr"

LOOKS = {
    "5207": ["--camera", "kodak-5207"],
    "portra-400": ["--camera", "kodak-portra-400"],
    "5219-on-2393": ["--camera", "kodak-5219", "--print", "kodak-2393"],
    "ektachrome-100": ["--camera", "kodak-ektachrome-100"],
    "velvia-50": ["--camera", "fuji-velvia-50"],
    "kodachrome-64": ["--camera", "kodak-kodachrome-64"],
    "first": ["--camera", "kodak-5207", "--approach", "first"],
    "reinhard": ["--approach", "reinhard"],
    "5207-sheet": ["--camera", "kodak-5207", "--aim", "sheet"],
    "5207-p3": ["--camera", "kodak-5207", "--output-space", "p3"],
}
# Structured tables are fitted on two cores in a few seconds each: 16^3 shows a change as well as 32^3.
BAKES = {
    "plain": ["--quick", "--format", "cube,clf,spi3d,ktx2"],
    "plain-fitted-f16": ["--quick", "--size", "17", "--entries", "fitted", "--storage", "f16"],
    "hald": ["--quick", "--shaper", "srgb", "--size", "16", "--format", "hald"],
    "strips": ["--quick", "--shaper", "srgb", "--size", "32", "--format", "unreal,unity,cube"],
    "acescct": ["--quick", "--shaper", "acescct", "--size", "17", "--format", "cube,clf"],
    "logc4": ["--quick", "--shaper", "logc4", "--size", "17", "--format", "cube,clf"],
    "bevy": ["--quick", "--shaper", "bevy", "--size", "32", "--format", "ktx2"],
    "structured": ["--quick", "--form", "structured", "--size", "16"],
    "structured-display": ["--quick", "--form", "structured", "--size", "16", "--coding", "display", "--storage", "unorm10"],
    "direct": ["--quick", "--form", "direct"],
}
# With certificate, report and preview, for one look: what they say is measured, not only written.
CERTIFIED = {"plain": [], "structured": ["--form", "structured", "--size", "16"], "direct": ["--form", "direct"]}
FORMS = ["reference", "plain", "structured", "direct"]


def run(program, arguments):
    """The command's status and what it said, without where it wrote and how long it took."""
    result = subprocess.run([program, *arguments], cwd=ROOT, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    return result.returncode, result.stderr.strip()


def pixels(data):
    """A picture without what its header says of the look: the inflated samples of a PNG, the blocks of an EXR."""
    if data.startswith(b"\x89PNG"):
        at, samples = 8, b""
        while at < len(data):
            length, kind = struct.unpack(">I4s", data[at : at + 8])
            samples += data[at + 8 : at + 8 + length] if kind == b"IDAT" else b""
            at += 12 + length
        return zlib.decompress(samples)
    at = 8
    while data[at]:
        at = data.index(b"\0", data.index(b"\0", at) + 1) + 1
        at += 4 + struct.unpack("<I", data[at : at + 4])[0]
    # Behind the header lie the offsets of the blocks, the first block's before the others.
    return data[struct.unpack("<Q", data[at + 1 : at + 9])[0] :]


def digest(path, only_pixels):
    """SHA-256 of a file; of look.json without its times and file names."""
    data = path.read_bytes()
    if only_pixels and path.name.startswith("scene."):
        data = pixels(data)
    if path.name == "look.json":
        report = json.loads(data)
        for key in ("files", "seconds"):
            report.pop(key, None)
        data = json.dumps(report, sort_keys=True).encode()
    return hashlib.sha256(data).hexdigest()


def record(program, folder, name, arguments, found, only_pixels):
    status, said = run(program, arguments)
    print(f"{name}: status {status}", file=sys.stderr)
    if status != 0:
        found[name] = {"refused": said.replace(str(folder), "")}
        return
    files = sorted(path for path in folder.rglob("*") if path.is_file())
    found[name] = {str(path.relative_to(folder)): digest(path, only_pixels) for path in files}


def digests(program, preset, only_pixels):
    found = {}
    with tempfile.TemporaryDirectory() as temporary:
        for look, options in LOOKS.items():
            if preset and look not in ("first", "reinhard"):
                options = [*options, "--preset", preset]
            bakes = {**BAKES, **({f"certified-{k}": v for k, v in CERTIFIED.items()} if look == "5207" else {})}
            for bake, recipe in bakes.items():
                folder = pathlib.Path(temporary) / look / bake
                folder.mkdir(parents=True)
                record(program, folder, f"bake {bake} {look}", ["bake", *options, *recipe, "--out", str(folder)], found, only_pixels)
            for form in FORMS:
                for kind in ("png", "exr"):
                    folder = pathlib.Path(temporary) / look / f"develop-{form}-{kind}"
                    folder.mkdir(parents=True)
                    arguments = ["develop", str(SCENE), str(folder / f"scene.{kind}"), *options, "--form", form]
                    # 8 bits are dithered: 16 show what was computed.
                    arguments += ["--bits", "16"] if kind == "png" else []
                    record(program, folder, f"develop {form} {kind} {look}", arguments, found, only_pixels)
    return found


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program", type=pathlib.Path, help="a built xtask, such as target/release/xtask")
    parser.add_argument("--preset", help="a preset for the looks of film, such as talk: the settings of older versions")
    parser.add_argument("--pixels", action="store_true", help="of developed pictures the pixels alone, not what the file says of the look")
    parser.add_argument("--against", type=pathlib.Path, metavar="JSON", help="digests of another build to compare with")
    arguments = parser.parse_args()
    found = digests(arguments.program.resolve(), arguments.preset, arguments.pixels)
    if arguments.against is None:
        json.dump(found, sys.stdout, indent=1, sort_keys=True)
        print()
        return 0
    before = json.loads(arguments.against.read_text())
    different = 0
    for name in sorted(before.keys() | found.keys()):
        old, new = before.get(name, {}), found.get(name, {})
        for file in sorted(old.keys() | new.keys()):
            if old.get(file) != new.get(file):
                different += 1
                print(f"{name}, {file}: {old.get(file, 'missing')} before, {new.get(file, 'missing')} now")
    same = sum(len(files) for files in found.values())
    print(f"{same} files, {different} differ")
    return 1 if different else 0


if __name__ == "__main__":
    sys.exit(main())

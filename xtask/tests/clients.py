#!/usr/bin/env python3
"""Applies OpenColorIO to baked LUT files and compares it with our own output.

The folder holds the files and probes.txt: a first line "# r g b FILE FILE ...", then one line per colour with the
scene-linear input and our output for each FILE, three numbers each. A FILE may be a .clf, a .cube, or an .ocio, of which
the usual view is taken.

OpenColorIO's shaders are compiled and run too, and compared with OpenColorIO on the processor.

Prints the largest difference per file. Exit status 1 if one is above the tolerance or not finite.
Needs opencolorio 2, numpy and moderngl; without them it says "skipped", and fails only with --require.
"""

import argparse
import pathlib
import shutil
import sys
import tempfile


def read_probes(path):
    """Names of the files, inputs (n, 3) and outputs (n, 3) for each."""
    with open(path, encoding="utf-8") as lines:
        heading = lines.readline().split()
    if heading[:4] != ["#", "r", "g", "b"] or len(heading) < 5:
        sys.exit(f"{path}: first line: found {' '.join(heading)!r}, expected '# r g b FILE ...'")
    names = heading[4:]
    table = numpy.loadtxt(path, dtype=numpy.float32, ndmin=2)
    if table.shape[1] != 3 + 3 * len(names):
        sys.exit(f"{path}: found {table.shape[1]} numbers a line, expected {3 + 3 * len(names)}")
    outputs = {name: table[:, 3 + 3 * i : 6 + 3 * i] for i, name in enumerate(names)}
    return numpy.ascontiguousarray(table[:, :3]), outputs


def processor(path):
    """OpenColorIO's processor for one file."""
    if path.suffix == ".ocio":
        config = ocio.Config.CreateFromFile(str(path))
        config.validate()
        display = config.getDefaultDisplay()
        view = ocio.DisplayViewTransform(ocio.ROLE_SCENE_LINEAR, display, config.getDefaultView(display))
        return config.getProcessor(view)
    transform = ocio.FileTransform(str(path))
    transform.setInterpolation(ocio.INTERP_TETRAHEDRAL)
    return ocio.Config.CreateRaw().getProcessor(transform)


def worst(name, found, expected, inputs):
    """Prints the largest difference and returns it."""
    difference = numpy.abs(found - expected).max(axis=1)
    difference = numpy.where(numpy.isnan(difference), numpy.inf, difference)
    at = int(difference.argmax())
    print(
        f"{name}: largest difference {difference[at]:.2e} over {len(inputs)} colours,"
        f" at {' '.join(f'{v:g}' for v in inputs[at])}"
    )
    return difference[at]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=pathlib.Path, help="folder with probes.txt and the files it names")
    parser.add_argument("--tolerance", type=float, default=2e-4, help="largest difference allowed (default 2e-4)")
    parser.add_argument("--shader-tolerance", type=float, default=1e-4, help="the same for the shader (default 1e-4)")
    parser.add_argument("--require", action="store_true", help="fail where opencolorio or numpy is missing")
    arguments = parser.parse_args()
    if missing:
        print(f"skipped: {missing} is not installed")
        return 1 if arguments.require else 0

    inputs, outputs = read_probes(arguments.folder / "probes.txt")
    finite = numpy.isfinite(inputs).all(axis=1)
    inputs = inputs[finite]
    failed = False
    # OpenColorIO keeps files it has read by their path: fresh names, so that no older file answers.
    with tempfile.TemporaryDirectory() as fresh:
        for part in arguments.folder.glob("look.*"):
            shutil.copy(part, fresh)
        for name, ours in outputs.items():
            used = processor(pathlib.Path(fresh) / name)
            theirs = inputs.copy()
            used.getDefaultCPUProcessor().applyRGB(theirs)
            failed |= not worst(name, theirs, ours[finite], inputs) <= arguments.tolerance
            shaded, renderer = shader.apply(used, inputs)
            failed |= not worst(f"{name} by {renderer}", shaded, theirs, inputs) <= arguments.shader_tolerance
    return 1 if failed else 0


missing = None
try:
    import numpy
    import PyOpenColorIO as ocio

    import shader
except ImportError as error:
    missing = error.name or str(error)

if __name__ == "__main__":
    sys.exit(main())

#!/usr/bin/env python3
"""Lets programs apply the LUTs that `cargo xtask bake --for all` writes, and says how far each is from the film.

    benches/clients/run.py FOLDER XTASK [--require PROGRAM,...]

FOLDER is what `bake --for all --output-coding srgb --out FOLDER` wrote, XTASK the built runner, which develops the same colours exactly. Prints one
line of a table for each program and file: largest and mean CIEDE2000 over 16384 colours, and the program's version. A
program that is not installed is left out, unless --require names it: then it must be there and near the film. Needs ffmpeg, which makes and reads the pictures,
and numpy; PyOpenColorIO, oiiotool, gmic, ImageMagick, RawTherapee, darktable, bpy and Node with three where they are there.
"""

import argparse
import base64
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import zlib

import numpy

SIDE = 128

# The largest CIEDE2000 from the film that a required program may have: four times what its table is certified for.
LIMIT = 1.2


def run(*command, **more):
    """Standard output of a command; its complaint where it fails."""
    done = subprocess.run([str(word) for word in command], capture_output=True, check=False, **more)
    if done.returncode != 0:
        said = (done.stderr + done.stdout).decode(errors="replace").strip()
        raise RuntimeError(f"{command[0]}: status {done.returncode}: {said[-300:]}")
    return done.stdout


def write_png(path, rgb):
    codes = numpy.round(numpy.clip(rgb, 0, 1) * 65535).astype("<u2").tobytes()
    size = ["-f", "rawvideo", "-pix_fmt", "rgb48le", "-s", f"{SIDE}x{SIDE}"]
    run("ffmpeg", "-v", "error", "-y", *size, "-i", "-", "-pix_fmt", "rgb48be", path, input=codes)


def read_picture(path):
    codes = run("ffmpeg", "-v", "error", "-i", path, "-f", "rawvideo", "-pix_fmt", "rgb48le", "-")
    return numpy.frombuffer(codes, "<u2").reshape(-1, 3) / 65535


def coded_colours():
    """sRGB codes of colours over ten stops and all saturations, with the corners of the cube; black is one."""
    random = numpy.random.default_rng(13)
    light = 2 ** random.uniform(-10, 0, (SIDE * SIDE, 1)) * (1 - random.uniform(0, 1, (SIDE * SIDE, 3)) ** 2)
    corners = numpy.indices((9, 9, 9)).reshape(3, -1).T / 8
    codes = numpy.where(light <= 0.0031308, 12.92 * light, 1.055 * light ** (1 / 2.4) - 0.055)
    codes[: len(corners)] = corners
    return numpy.round(codes * 65535) / 65535


def lab(codes):
    codes = numpy.clip(codes, 0, 1)
    light = numpy.where(codes <= 0.04045, codes / 12.92, ((codes + 0.055) / 1.055) ** 2.4)
    to_xyz = numpy.array([[0.4123908, 0.3575843, 0.1804808], [0.2126390, 0.7151687, 0.0721923], [0.0193308, 0.1191948, 0.9505322]])
    relative = light @ (to_xyz / to_xyz.sum(axis=1, keepdims=True)).T
    root = numpy.where(relative > (6 / 29) ** 3, numpy.cbrt(relative), relative / (3 * (6 / 29) ** 2) + 4 / 29)
    x, y, z = root.T
    return 116 * y - 16, 500 * (x - y), 200 * (y - z)


def ciede2000(first, second):
    """Differences of two lists of sRGB codes [CIE142]."""
    (l1, a1, b1), (l2, a2, b2) = lab(first), lab(second)
    mean7 = ((numpy.hypot(a1, b1) + numpy.hypot(a2, b2)) / 2) ** 7
    stretch = 1.5 - 0.5 * numpy.sqrt(mean7 / (mean7 + 25.0**7))
    c1, c2 = numpy.hypot(stretch * a1, b1), numpy.hypot(stretch * a2, b2)
    h1, h2 = (numpy.degrees(numpy.arctan2(b, stretch * a)) % 360 for a, b in ((a1, b1), (a2, b2)))
    turn = (h2 - h1 + 180) % 360 - 180
    turn = numpy.where(c1 * c2 == 0, 0, turn)
    dh = 2 * numpy.sqrt(c1 * c2) * numpy.sin(numpy.radians(turn / 2))
    hue = numpy.radians(numpy.where(c1 * c2 == 0, h1 + h2, h1 + turn / 2) % 360)
    l, c = (l1 + l2) / 2, (c1 + c2) / 2
    t = 1 - 0.17 * numpy.cos(hue - numpy.radians(30)) + 0.24 * numpy.cos(2 * hue)
    t += 0.32 * numpy.cos(3 * hue + numpy.radians(6)) - 0.2 * numpy.cos(4 * hue - numpy.radians(63))
    sl = 1 + 0.015 * (l - 50) ** 2 / numpy.sqrt(20 + (l - 50) ** 2)
    sc, sh = 1 + 0.045 * c, 1 + 0.015 * c * t
    bend = numpy.radians(60 * numpy.exp(-(((numpy.degrees(hue) - 275) / 25) ** 2)))
    turned = -2 * numpy.sqrt(c**7 / (c**7 + 25.0**7)) * numpy.sin(bend)
    dl, dc, dh = (l2 - l1) / sl, (c2 - c1) / sc, dh / sh
    return numpy.sqrt(numpy.maximum(dl**2 + dc**2 + dh**2 + turned * dc * dh, 0))


def first_line(*command):
    return run(*command).decode(errors="replace").strip().splitlines()[0]


def ffmpeg_cube(work, folder):
    filters = f"format=gbrp16le,lut3d={folder / 'look.srgb.cube'}:interp=tetrahedral"
    run("ffmpeg", "-v", "error", "-y", "-i", work / "in.png", "-vf", filters, "-pix_fmt", "rgb48be", work / "out.png")
    return " ".join(first_line("ffmpeg", "-version").split()[:3:2])


def ffmpeg_hald(work, folder):
    # Not planar: ffmpeg 5.1 reads a planar Hald with its channels exchanged.
    graph = "[0]format=rgb48[a];[1]format=rgb48[b];[a][b]haldclut=interp=tetrahedral"
    inputs = ["-i", work / "in.png", "-i", folder / "look.srgb.hald.png"]
    run("ffmpeg", "-v", "error", "-y", *inputs, "-filter_complex", graph, "-pix_fmt", "rgb48be", work / "out.png")
    return " ".join(first_line("ffmpeg", "-version").split()[:3:2])


def imagemagick_hald(work, folder):
    program = shutil.which("magick") or shutil.which("convert-im6.q16") or "convert"
    run(program, work / "in.png", folder / "look.srgb.hald.png", "-hald-clut", "-depth", "16", work / "out.png")
    return " ".join(first_line(program, "-version").split()[1:3])


def gmic_cube(work, folder):
    table = ["-input_cube", folder / "look.srgb.cube", "-map_clut[0]", "[1]", "-keep[0]"]
    run("gmic", work / "in.png", "-div", "257", *table, "-mul", "257", "-round", "-o", work / "out.png")
    return "G'MIC " + re.search(r"\d+\.\d+\.\d+", run("gmic", "-help").decode(errors="replace"))[0]


def oiiotool_version():
    return "oiiotool " + re.search(r"\d+\.\d+\.\d+[.\d]*", run("oiiotool", "--help").decode(errors="replace"))[0]


def oiiotool_cube(work, folder):
    # It wants a configuration, whichever.
    environment = os.environ | {"OCIO": str(folder / "look.ocio")}
    transform = ["--ociofiletransform", folder / "look.srgb.cube", "-d", "uint16", "-o", work / "out.png"]
    run("oiiotool", work / "in.png", *transform, env=environment)
    return oiiotool_version()


def oiiotool_display(work, folder):
    light = ["--colorconfig", folder / "look.ocio", work / "in.png", "-d", "float", "--iscolorspace", "sRGB"]
    view = re.search(r'<View> {name: "([^"]*)"', (folder / "look.ocio").read_text(encoding="utf-8"))[1]
    light += ["--tocolorspace", "scene_linear", "--ociodisplay", "sRGB", view]
    run("oiiotool", *light, "-d", "uint16", "-o", work / "out.png")
    return oiiotool_version()


def rawtherapee_hald(work, folder):
    (work / "look.pp3").write_text(
        "[Version]\nVersion=346\n"
        f"[Film Simulation]\nEnabled=true\nClutFilename={folder / 'look.srgb.hald.png'}\nStrength=100\n",
        encoding="utf-8",
    )
    run("rawtherapee-cli", "-Y", "-a", "-n", "-b16", "-o", work / "out.png", "-p", work / "look.pp3", "-c", work / "in.png")
    # It says its version with a status of failure.
    said = subprocess.run(["rawtherapee-cli", "-v"], capture_output=True, check=False).stdout.decode(errors="replace")
    return "RawTherapee " + re.search(r"\d+\.\d+", said)[0]


DARKTABLE = """<?xml version="1.0" encoding="UTF-8"?>
<x:xmpmeta xmlns:x="adobe:ns:meta/"><rdf:RDF xmlns:rdf="http://www.w3.org/1999/02/22-rdf-syntax-ns#">
<rdf:Description rdf:about="" xmlns:darktable="http://darktable.sf.net/" darktable:xmp_version="5" darktable:history_end="1"
darktable:iop_order_version="2"><darktable:history><rdf:Seq><rdf:li darktable:num="0" darktable:operation="lut3d" darktable:enabled="1"
darktable:modversion="3" darktable:params="{}" darktable:multi_priority="0"/></rdf:Seq></darktable:history></rdf:Description>
</rdf:RDF></x:xmpmeta>
"""


def darktable_cube(work, folder):
    # Version 3 of the module's settings: the file's path below the LUT folder, application colour space (0: sRGB), interpolation
    # (0: tetrahedral), and what only compressed LUTs have.
    settings = b"look.srgb.cube".ljust(512, b"\0") + bytes(4 + 4 + 4 + 2048 * 2 * 3 + 128)
    packed = zlib.compress(settings, 9)
    text = f"gz{min(len(settings) // len(packed) + 1, 99):02}" + base64.b64encode(packed).decode()
    (work / "look.xmp").write_text(DARKTABLE.format(text), encoding="utf-8")
    conf = [f"plugins/darkroom/lut3d/def_path={folder}", "plugins/imageio/format/png/bpp=16"]
    core = ["--core", "--configdir", work / "darktable", "--library", ":memory:", *(word for line in conf for word in ("--conf", line))]
    run("darktable-cli", work / "in.png", work / "look.xmp", work / "out.png", *core)
    return "darktable " + re.search(r"\d+\.\d+\.\d+", run("darktable-cli", "--version").decode(errors="replace"))[0]


BLENDER = """
import os, sys
os.environ["OCIO"] = sys.argv[1]
import bpy
scene = bpy.context.scene
image = bpy.data.images.load(sys.argv[2])
image.colorspace_settings.name = "sRGB"
scene.render.image_settings.file_format = "PNG"
scene.render.image_settings.color_depth = "16"
image.save_render(sys.argv[3], scene=scene)
print("Blender " + bpy.app.version_string)
"""


def blender_view(work, folder):
    said = run(sys.executable, "-c", BLENDER, folder / "look.ocio", work / "in.png", work / "out.png")
    return said.decode().strip().splitlines()[-1]


KTX2 = """
import fs from "node:fs";
import { KTX2Loader } from "three/examples/jsm/loaders/KTX2Loader.js";
import { REVISION, HalfFloatType } from "three";
const loader = new KTX2Loader();
// Only compressed textures ask what the graphics card supports.
loader.workerConfig = {};
const bytes = fs.readFileSync(process.argv[2]);
const buffer = bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.byteLength);
loader.parse(buffer, (texture) => {
  if (texture.type !== HalfFloatType) throw new Error("no half floats");
  const { width, height, depth, data } = texture.image;
  fs.writeFileSync(process.argv[3], Buffer.from(data.buffer, data.byteOffset, data.byteLength));
  console.log(JSON.stringify({ size: [width, height, depth], revision: REVISION }));
}, (error) => { throw error; });
"""

THREE = """
import fs from "node:fs";
import { LUTCubeLoader } from "three/examples/jsm/loaders/LUTCubeLoader.js";
import { REVISION, FloatType } from "three";
const loader = new LUTCubeLoader().setType(FloatType);
const { size, texture3D } = loader.parse(fs.readFileSync(process.argv[2], "utf8"));
fs.writeFileSync(process.argv[3], Buffer.from(new Float32Array(texture3D.image.data).buffer));
console.log(JSON.stringify({ size, revision: REVISION }));
"""


def by_three(program, file, work):
    """What a program for Node that imports three.js says of a file."""
    modules = pathlib.Path(__file__).resolve().parents[2] / "target/three/node_modules"
    if not modules.is_dir():
        raise FileNotFoundError("target/three: npm install --prefix target/three three")
    script = modules.parent / "load.mjs"
    script.write_text(program, encoding="utf-8")
    return json.loads(run("node", script, file, work / "table.raw"))


def filtered(table, coordinates):
    """A texture as hardware reads it: trilinear between texel centres; blue is the slowest axis of the table."""
    size = len(table)
    at = numpy.clip(coordinates, 0, 1) * (size - 1)
    low = numpy.minimum(at.astype(int), size - 2)
    part = at - low
    out = 0
    for corner in numpy.ndindex(2, 2, 2):
        weight = numpy.prod(numpy.where(corner, part, 1 - part), axis=1, keepdims=True)
        r, g, b = (low + corner).T
        out = out + weight * table[b, g, r]
    return out


def three_cube(work, folder):
    said = by_three(THREE, folder / "look.srgb.cube", work)
    table = numpy.fromfile(work / "table.raw", numpy.float32).reshape([said["size"]] * 3 + [4])[..., :3]
    write_png(work / "out.png", filtered(table, read_picture(work / "in.png")))
    return f"three.js r{said['revision']}"


def three_ktx2(work, folder):
    """Light in by log2 of light over 18 % grey from -11 to +12, as in Bevy's shader, and light out."""
    said = by_three(KTX2, folder / "look.bevy.ktx2", work)
    table = numpy.fromfile(work / "table.raw", numpy.float16).astype(float).reshape(said["size"] + [4])[..., :3]
    codes = read_picture(work / "in.png")
    light = numpy.where(codes <= 0.04045, codes / 12.92, ((codes + 0.055) / 1.055) ** 2.4)
    shown = filtered(table, (numpy.log2(numpy.maximum(light, 1e-12) / 0.18) + 11) / 23)
    write_png(work / "out.png", numpy.where(shown <= 0.0031308, 12.92 * shown, 1.055 * numpy.maximum(shown, 0) ** (1 / 2.4) - 0.055))
    return f"three.js r{said['revision']}"


PROGRAMS = {
    "ffmpeg": [("look.srgb.cube", "lut3d, tetrahedral, 16 bit", ffmpeg_cube), ("look.srgb.hald.png", "haldclut, 16 bit", ffmpeg_hald)],
    "imagemagick": [("look.srgb.hald.png", "-hald-clut", imagemagick_hald)],
    "gmic": [("look.srgb.cube", "map_clut", gmic_cube)],
    "oiiotool": [("look.srgb.cube", "--ociofiletransform", oiiotool_cube), ("look.ocio", "--ociodisplay", oiiotool_display)],
    "rawtherapee": [("look.srgb.hald.png", "film simulation", rawtherapee_hald)],
    "darktable": [("look.srgb.cube", "lut 3D, tetrahedral, 16 bit", darktable_cube)],
    "blender": [("look.ocio", "view", blender_view)],
    "three": [("look.srgb.cube", "LUTCubeLoader", three_cube), ("look.bevy.ktx2", "KTX2Loader, Bevy's shaper", three_ktx2)],
}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=pathlib.Path, help="what bake --for all wrote")
    parser.add_argument("xtask", type=pathlib.Path, help="the built runner")
    parser.add_argument("--require", default="", help="programs that must be there, comma-separated")
    arguments = parser.parse_args()
    required = {name for name in arguments.require.split(",") if name}
    if unknown := required - PROGRAMS.keys():
        sys.exit(f"--require: found {', '.join(sorted(unknown))}, expected some of {', '.join(PROGRAMS)}")
    folder = arguments.folder.resolve()
    failed = False
    with tempfile.TemporaryDirectory() as work:
        work = pathlib.Path(work)
        write_png(work / "in.png", coded_colours().reshape(SIDE, SIDE, 3))
        film = ["develop", work / "in.png", work / "film.png", "--look", folder / "look.toml", "--form", "reference"]
        run(arguments.xtask.resolve(), *film, "--input-coding", "srgb", "--bits", "16")
        film = read_picture(work / "film.png")
        print("| program | file | how | largest dE | mean dE |\n|---|---|---|---|---|")
        for program, ways in PROGRAMS.items():
            for file, how, apply in ways:
                (work / "out.png").unlink(missing_ok=True)
                try:
                    version = apply(work, folder)
                    found = ciede2000(read_picture(work / "out.png"), film)
                    failed |= program in required and not found.max() <= LIMIT
                    print(f"| {version} | `{file}` | {how} | {found.max():.2f} | {found.mean():.3f} |")
                except (OSError, RuntimeError, ValueError) as error:
                    failed |= program in required
                    print(f"{program}, {file}: {error}", file=sys.stderr)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())

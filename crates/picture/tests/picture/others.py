"""Reads pictures with OpenImageIO and OpenEXR: others.py OUT FILE... writes OUT/NAME.f32, rows of RGB floats, of what they hold.

A file that neither reads is left out. Luminance and chroma, which neither makes RGB of here, is put together with numpy.
"""
import sys
from pathlib import Path

import numpy as np
import OpenEXR
import OpenImageIO as oiio

# Of ImfRgbaYca, from the far left to the far right.
TAPS = [0.002128, -0.007540, 0.019597, -0.043159, 0.087929, -0.186077, 0.627123]
TAPS += TAPS[::-1]


def full(plane, axis):
    """Twice the samples along an axis, the new ones between by the taps; the ends are repeated."""
    plane = np.moveaxis(plane, axis, 0)
    padded = np.concatenate([plane[:1]] * 6 + [plane] + [plane[-1:]] * 7)
    between = sum(tap * padded[i : i + len(plane)] for i, tap in enumerate(TAPS))
    return np.moveaxis(np.stack([plane, between], 1).reshape(-1, *plane.shape[1:]), 0, axis)


def rgb_of_chroma(channels):
    luminance, ry, by = (channels[name].astype(np.float64) for name in ("Y", "RY", "BY"))
    if ry.shape != luminance.shape:
        ry, by = (full(full(plane, 0), 1) for plane in (ry, by))
    red, blue = (ry + 1) * luminance, (by + 1) * luminance
    # Luminance of BT.709's primaries, from their chromaticities.
    xyz = lambda x, y: np.array([x / y, 1, (1 - x - y) / y])
    primaries = np.stack([xyz(0.64, 0.33), xyz(0.3, 0.6), xyz(0.15, 0.06)], 1)
    of_red, of_green, of_blue = np.linalg.solve(primaries, xyz(0.3127, 0.329))
    rgb = np.stack([red, (luminance - of_red * red - of_blue * blue) / of_green, blue], -1)
    grey = (ry == 0) & (by == 0)
    rgb[grey] = luminance[grey][:, None]
    if "A" in channels:
        rgb /= channels["A"].astype(np.float64)[..., None]
    return rgb


def of_exr(path):
    with OpenEXR.File(str(path), separate_channels=True) as file:
        for part in sorted(file.parts, key=lambda part: part.name() != "beauty"):
            channels = {name: channel.pixels for name, channel in part.channels.items()}
            if {"Y", "RY", "BY"} <= channels.keys():
                return rgb_of_chroma(channels)
            for names in ("RGB", "XYZ", "rgb", ("red", "green", "blue"), ("color.R", "color.G", "color.B"), *(
                tuple(f"{layer}.{c}" for c in "RGB") for layer in ("ViewLayer.Combined", "b.x")), "YYY", "VVV"):
                if set(names) <= channels.keys():
                    rgb = np.stack([channels[name] for name in names], -1).astype(np.float64)
                    alpha = channels.get(names[0][:-1] + "A")
                    if alpha is not None:
                        covered = alpha[..., None].astype(np.float64)
                        rgb = np.divide(rgb, covered, out=rgb, where=covered > 1.2e-38)
                    return rgb


def of_oiio(path):
    hints = oiio.ImageSpec()
    hints.attribute("oiio:UnassociatedAlpha", 1)
    picture = oiio.ImageInput.open(str(path), hints)
    if picture is None:
        return None
    subimage = 0
    while picture.spec().get_int_attribute("tiff:subfiletype", 0) & 1 and picture.seek_subimage(subimage + 1, 0):
        subimage += 1
    spec = picture.spec_dimensions(subimage)
    pixels = picture.read_image(subimage, 0, 0, spec.nchannels, "float")
    if pixels is None:
        return None
    turn = picture.spec().get_int_attribute("Orientation", 1)
    pixels = np.asarray(pixels).reshape(spec.height, spec.width, -1)
    if turn != 1:
        buffer = oiio.ImageBuf(np.ascontiguousarray(pixels))
        buffer.specmod().attribute("Orientation", turn)
        pixels = oiio.ImageBufAlgo.reorient(buffer).get_pixels(oiio.FLOAT)
    grey = pixels.shape[2] < 3
    rgb = pixels[..., [0, 0, 0]] if grey else pixels[..., :3]
    # Without extra samples' word OpenImageIO takes alpha for premultiplied, we for straight, with a note.
    if path.name == "premultiplied.tif" and not picture.spec().get_int_attribute("oiio:UnassociatedAlpha", 0):
        alpha = pixels[..., spec.alpha_channel, None]
        rgb = np.divide(rgb, alpha, out=rgb.copy(), where=alpha > 0)
    return rgb


for name in sys.argv[2:]:
    path = Path(name)
    pixels = of_exr(path) if path.suffix == ".exr" else of_oiio(path)
    if pixels is not None:
        pixels = np.ascontiguousarray(pixels, np.float32)
        (Path(sys.argv[1]) / f"{path.parent.name}-{path.name}.f32").write_bytes(pixels.tobytes())

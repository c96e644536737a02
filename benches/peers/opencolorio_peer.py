"""OpenColorIO's side: the chain that equals our plain form, from the same numbers.

A LogAffineTransform and a tetrahedral Lut3D, default optimisation, one processor for each type of output, whole
pictures of packed RGBA.
"""

import math
import pathlib
import time
from concurrent.futures import ThreadPoolExecutor

import numpy
import PyOpenColorIO as ocio

from protocol import serve

TYPES = {"f32": (ocio.BIT_DEPTH_F32, numpy.float32), "u8": (ocio.BIT_DEPTH_UINT8, numpy.uint8)}
# Bands of rows for each thread, so that one which is held up leaves its share to the others.
BANDS = 4


class Session:
    def __init__(self):
        self.threads = 1
        self.pool = None
        self.processors = {}
        self.bands = {}

    def start_threads(self, count):
        self.threads = int(count)
        self.pool = ThreadPoolExecutor(self.threads) if self.threads > 1 else None
        if self.pool:
            list(self.pool.map(time.sleep, [0.01] * self.threads))

    def read(self, folder, width, height, nodes, offset, maximum):
        folder = pathlib.Path(folder)
        self.size = (int(height), int(width))
        self.picture = numpy.fromfile(folder / "picture.f32", numpy.float32).reshape(*self.size, 4)
        nodes = int(float(nodes))
        # Red varies fastest in our table, blue in theirs.
        table = numpy.fromfile(folder / "table.f32", numpy.float32).reshape(nodes, nodes, nodes, 3)
        self.table = numpy.ascontiguousarray(table.transpose(2, 1, 0, 3))
        self.shaper = float(offset), float(maximum)
        for kind in TYPES:
            self.bands[kind] = self.describe(kind)

    def describe(self, kind):
        """Source and target of each band. The bindings copy what they are given, so this is no part of a time."""
        depth, dtype = TYPES[kind]
        size = numpy.dtype(dtype).itemsize
        height, width = self.size
        count = self.threads * BANDS if self.pool else 1
        bands = []
        for i in range(count):
            rows = self.picture[height * i // count : height * (i + 1) // count]
            target = numpy.ones(rows.shape, dtype)
            bands.append(
                (
                    ocio.PackedImageDesc(rows, width, len(rows), 4),
                    ocio.PackedImageDesc(target, width, len(rows), 4, depth, size, 4 * size, 4 * size * width),
                )
            )
        return bands

    def build(self, kind):
        """From the table's numbers to a processor."""
        begin = time.perf_counter_ns()
        offset, maximum = self.shaper
        slope = 1.0 / math.log2(1.0 + maximum / offset)
        shaper = ocio.LogAffineTransform(
            logSideSlope=[slope] * 3,
            logSideOffset=[-slope * math.log2(offset)] * 3,
            linSideSlope=[1.0] * 3,
            linSideOffset=[offset] * 3,
        )
        shaper.setBase(2.0)
        table = ocio.Lut3DTransform(gridSize=len(self.table), interpolation=ocio.INTERP_TETRAHEDRAL)
        table.setData(self.table.ravel())
        chain = ocio.Config.CreateRaw().getProcessor(ocio.GroupTransform([shaper, table]))
        self.processors[kind] = chain.getOptimizedCPUProcessor(
            ocio.BIT_DEPTH_F32, TYPES[kind][0], ocio.OPTIMIZATION_DEFAULT
        )
        return [time.perf_counter_ns() - begin]

    def apply(self, kind, runs):
        processor, bands = self.processors[kind], self.bands[kind]
        times = []
        for _ in range(int(runs)):
            begin = time.perf_counter_ns()
            if self.pool:
                # `apply` lets other threads run.
                list(self.pool.map(lambda band: processor.apply(*band), bands))
            else:
                processor.apply(*bands[0])
            times.append(time.perf_counter_ns() - begin)
        return times

    def compare(self, kind, path):
        """Largest difference of the last result from a file's: of values in f32, of codes in u8."""
        theirs = numpy.concatenate([target.getData().ravel() for _, target in self.bands[kind]])
        ours = numpy.fromfile(path, TYPES[kind][1])
        if ours.size != theirs.size:
            raise ValueError(f"{path}: found {ours.size} samples, expected {theirs.size}")
        worst = 0.0
        for begin in range(0, ours.size, 1 << 22):
            piece = slice(begin, begin + (1 << 22))
            difference = numpy.abs(ours[piece].astype(numpy.float64) - theirs[piece])
            worst = max(worst, float(numpy.where(numpy.isnan(difference), numpy.inf, difference).max()))
        return [worst]


if __name__ == "__main__":
    session = Session()
    serve(
        {
            "threads": session.start_threads,
            "read": session.read,
            "build": session.build,
            "apply": session.apply,
            "compare": session.compare,
        }
    )

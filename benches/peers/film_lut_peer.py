"""spectral-film-lut's side: its nearest equal look, Kodak 5207 printed on 2383, as a table.

By itself it answers commands; with a file and a size it is the shortest program that makes that `.cube`, for timing a
whole process.
"""

import os
import sys
import time

from protocol import serve


def films():
    """Both films, read from their sheets."""
    import spectral_film_lut
    from spectral_film_lut.film_spectral import FilmSpectral

    return FilmSpectral(spectral_film_lut.KODAK_5207), FilmSpectral(spectral_film_lut.KODAK_2383)


def bake(negative, printed, size, **file):
    """A table from linear BT.709 to sRGB."""
    from spectral_film_lut.utils import create_lut

    settings = {"input_colorspace": "ITU-R BT.709", "gamma_func": "sRGB", "lut_size": size}
    return create_lut(negative, printed, **settings, **(file or {"cube": False}))


class Session:
    def __init__(self):
        self.films = None

    def compile(self):
        begin = time.perf_counter_ns()
        self.films = films()
        return [time.perf_counter_ns() - begin]

    def bake(self, size, runs):
        times = []
        for _ in range(int(runs)):
            begin = time.perf_counter_ns()
            table = bake(*self.films, int(size))
            times.append(time.perf_counter_ns() - begin)
            if table.shape != (int(size),) * 3 + (3,):
                raise ValueError(f"a table of shape {table.shape}")
        return times


if __name__ == "__main__":
    if len(sys.argv) == 3:
        folder, name = os.path.split(sys.argv[1])
        os.chdir(folder)
        bake(*films(), int(sys.argv[2]), cube=True, name=name.removesuffix(".cube"))
    else:
        session = Session()
        serve({"compile": session.compile, "bake": session.bake})

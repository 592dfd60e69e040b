"""`antumbra sky`: an environment of a clear sky with its sun."""

from __future__ import annotations

import math
import time
from datetime import datetime
from pathlib import Path

import click

from antumbra import _core
from antumbra.cli import _say
from antumbra.cli._command import Option, Verb, output_option
from antumbra.lights import Sky

ORDER = 8
# Lumens of a watt of our unit: the luminous efficacy of light at 555 nm.
_LUMENS = 683.0
_REC_709 = (0.2126, 0.7152, 0.0722)


def run(
    output: str | None,
    elevation: float | None,
    azimuth: float | None,
    place: str | None,
    moment: str | None,
    turbidity: float,
    albedo: float,
    width: int,
    sun: str,
    quiet: bool,
    verbose: bool,
) -> int:
    """Write a clear sky with its sun: where it stands is given as angles, or as a place and a time."""
    path = output or "sky.exr"
    if Path(path).suffix.lower() not in (".exr", ".png"):
        raise click.UsageError(f'"{path}": a picture ends in .exr or .png')
    sky = _sky(elevation, azimuth, place, moment, turbidity, albedo)
    _core.check_writable(path)
    began = time.perf_counter()
    pixels, words, faced = _core.sky(sky.fields(), width, sun == "on")
    _core.write_picture(path, pixels)
    seconds = _say.seconds(time.perf_counter() - began)
    stands = f"sun {_degrees(sky.elevation)} high at {_degrees(sky.azimuth)} ({_compass(sky.azimuth)})"
    print(f"{path}   {seconds} · {width:,} × {width // 2:,} · {stands}")
    if not quiet:
        level = _level(sky, width, faced)
        white = level / math.pi
        ground = f"level ground {_say.significant(level * _LUMENS / 1000)} klx"
        shows = f"--exposure {-math.log2(white):.1f} shows it white"
        print(f"{ground} · white there has radiance {_say.significant(white)}: {shows}")
        print(f"the same with a sharp sun: antumbra render SCENE --environment {words}")
    return 0


VERB = Verb(
    "sky",
    run,
    arguments=[],
    examples=[
        ("antumbra sky --elevation 30 --azimuth 120", "sky.exr; east-south-east"),
        ("antumbra sky --place 48.86,2.35 --time 2026-06-21T18:30+02:00", ""),
        ("antumbra sky --elevation 5 --turbidity 8 -o haze.exr", ""),
    ],
    options=[
        output_option("FILE", "the lat-long picture, .exr or .png [sky.exr]"),
        Option("--elevation", type=float, group="Light", metavar="DEGREES",
               help="of the sun above the horizon, 0 to 90 [45]"),
        Option("--azimuth", type=float, group="Light", metavar="DEGREES",
               help="of the sun, clockwise from north over east; north is -z, east +x [225]"),
        Option("--place", group="Light", metavar="LAT,LON",
               help="where on earth, in degrees, north and east positive; with --time, instead of the angles"),
        Option("--time", "moment", group="Light", metavar="ISO-8601",
               help="when, with its offset from UTC, as 2026-06-21T18:30+02:00, or Z"),
        Option("--turbidity", type=float, default=3.0, group="Light", metavar="T",
               help="haze, 1 to 10: 2 very clear, 3 clear, 6 hazy [3]"),
        Option("--albedo", type=float, default=0.3, group="Light", metavar="RHO",
               help="reflectance of the ground, which lights the sky and lies below the horizon [0.3]"),
        Option("--sun", type=click.Choice(["on", "off"]), default="on", group="Light", metavar="on|off",
               help="its disc, spread over the texels that it covers, its energy kept [on]"),
        Option("--width", type=click.IntRange(2, 16384), default=1024, group="Looks", metavar="N",
               help="texels around the horizon; half as many from top to bottom [1024]"),
    ],
)  # fmt: skip


def _sky(
    elevation: float | None,
    azimuth: float | None,
    place: str | None,
    moment: str | None,
    turbidity: float,
    albedo: float,
) -> Sky:
    """The sky that the options mean."""
    if (place is None) != (moment is None):
        raise click.UsageError("--place and --time belong together: where and when")
    try:
        if place is None or moment is None:
            angles = (
                math.radians(45 if elevation is None else elevation),
                math.radians(225 if azimuth is None else azimuth),
            )
            return Sky(*angles, turbidity=turbidity, albedo=albedo)
        if elevation is not None or azimuth is not None:
            raise click.UsageError("--elevation and --azimuth, or --place and --time: not both")
        latitude, longitude = _place(place)
        return Sky.at(_moment(moment), latitude, longitude, turbidity=turbidity, albedo=albedo)
    except ValueError as problem:
        raise click.UsageError(str(problem)) from None


def _place(text: str) -> tuple[float, float]:
    try:
        latitude, longitude = (math.radians(float(part)) for part in text.split(","))
    except ValueError:
        raise click.UsageError(f"--place {text}: two numbers are needed, as 48.86,2.35") from None
    return latitude, longitude


def _moment(text: str) -> datetime:
    try:
        return datetime.fromisoformat(text)
    except ValueError:
        raise click.UsageError(f"--time {text}: a time is needed, as 2026-06-21T18:30+02:00") from None


def _level(sky: Sky, width: int, faced: list[float]) -> float:
    """Luminance of the irradiance of level ground by dome and sun [W/m²]."""
    import numpy as np

    dome = sky.picture(min(width, 256), sun=False)[: min(width, 256) // 4] @ np.array(_REC_709)
    borders = np.cos(np.linspace(0, math.pi / 2, len(dome) + 1))
    each = (borders[:-1] ** 2 - borders[1:] ** 2) * math.pi / dome.shape[1]
    direct = float(np.dot(faced, _REC_709)) * math.sin(sky.elevation)
    return float((dome.sum(axis=1) * each).sum()) + direct


def _degrees(radians: float) -> str:
    return f"{math.degrees(radians):.2f}°"


_POINTS = ["north", "north-north-east", "north-east", "east-north-east", "east", "east-south-east", "south-east",
           "south-south-east", "south", "south-south-west", "south-west", "west-south-west", "west", "west-north-west",
           "north-west", "north-north-west"]  # fmt: skip


def _compass(azimuth: float) -> str:
    return _POINTS[round(math.degrees(azimuth) / 22.5) % 16]

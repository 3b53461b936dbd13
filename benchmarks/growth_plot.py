"""Draws how times grow, from the figures of benchmarks/run."""

from __future__ import annotations

from collections.abc import Sequence
from math import log2
from pathlib import Path

import matplotlib

matplotlib.use("svg")
from matplotlib import pyplot
from matplotlib.axes import Axes
from matplotlib.ticker import FixedLocator, LogLocator, NullLocator, StrMethodFormatter

GRIDS = (128, 256, 512, 1024, 2048)
PLANES = (2, 3, 4, 5, 6)
SCREENS = (4, 8, 16, 32, 64)
THREADS = (1, 2)


def curve(axes: Axes, x: Sequence[int], y: Sequence[float], marker: str, label: str) -> None:
    axes.loglog(x, y, color="black", marker=marker, markerfacecolor="white", label=label)


def guide(axes: Axes, x: Sequence[int], shape: Sequence[float], start: float, label: str) -> None:
    """A dashed line of a given shape through the first measured point."""
    scaled = [start * value / shape[0] for value in shape]
    axes.loglog(x, scaled, color="black", linestyle="--", linewidth=0.8, label=label)


def finish(axes: Axes, ticks: Sequence[int], x_label: str, y_label: str) -> None:
    axes.set_xlabel(x_label)
    axes.set_ylabel(y_label)
    axes.xaxis.set_major_locator(FixedLocator(list(ticks)))
    axes.yaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
    for axis in (axes.xaxis, axes.yaxis):
        axis.set_minor_locator(NullLocator())
        axis.set_major_formatter(StrMethodFormatter("{x:g}"))
    axes.margins(y=0.35)  # room for the legend
    axes.grid(color="0.85", linewidth=0.5)
    axes.legend(frameon=False, fontsize="small", loc="upper left", ncols=2)


def design_seconds(numbers: dict[str, float], screens: int, threads: int) -> float:
    return 1e-3 * numbers[f"design_with_screens/screens:{screens}/threads:{threads}"]


def draw_grids(axes: Axes, numbers: dict[str, float]) -> None:
    times = [numbers[f"loop_with_window/grid:{grid}"] for grid in GRIDS]
    curve(axes, GRIDS, times, "o", "four planes")
    guide(axes, GRIDS, [n**2 * log2(n) for n in GRIDS], times[0], "as N² log N")
    finish(axes, GRIDS, "grid N, samples per side", "time per loop, ms")


def draw_planes(axes: Axes, numbers: dict[str, float]) -> None:
    times = [numbers[f"loop_with_planes/planes:{planes}"] for planes in PLANES]
    curve(axes, PLANES, times, "o", "grid 512")
    guide(axes, PLANES, [planes + 1 for planes in PLANES], times[0], "as the hops, planes + 1")
    finish(axes, PLANES, "planes", "time per loop, ms")


def draw_screens(axes: Axes, numbers: dict[str, float]) -> None:
    for threads, marker, label in ((1, "o", "1 thread"), (2, "s", "2 threads")):
        times = [design_seconds(numbers, screens, threads) for screens in SCREENS]
        curve(axes, SCREENS, times, marker, label)
    guide(axes, SCREENS, SCREENS, design_seconds(numbers, SCREENS[0], 1), "as the screens")
    finish(axes, SCREENS, "screens", "time per design, s")


def draw_threads(axes: Axes, numbers: dict[str, float]) -> None:
    for screens, marker in ((4, "o"), (16, "s"), (64, "^")):
        times = [design_seconds(numbers, screens, threads) for threads in THREADS]
        curve(axes, THREADS, times, marker, f"{screens} screens")
        label = "as 1 / threads" if screens == SCREENS[-1] else "_unlisted"
        guide(axes, THREADS, [1 / threads for threads in THREADS], times[0], label)
    finish(axes, THREADS, "threads", "time per design, s")


def draw(numbers: dict[str, float], path: Path) -> None:
    pyplot.rcParams.update({"svg.fonttype": "none", "svg.hashsalt": "nlcwfs", "font.size": 9})
    figure, panels = pyplot.subplots(2, 2, figsize=(8, 6), layout="constrained")
    drawings = (draw_grids, draw_planes, draw_screens, draw_threads)
    for axes, draw_panel in zip(panels.flat, drawings, strict=True):
        draw_panel(axes, numbers)
    figure.savefig(path, metadata={"Date": None})

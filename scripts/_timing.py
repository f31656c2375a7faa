"""Timing diagrams as SVG: lanes of TRUE and FALSE, bands of values, and curves below, over one time axis."""

import itertools
from collections.abc import Iterator, Mapping, Sequence
from html import escape
from typing import Final, NamedTuple

WIDTH: Final = 860
LEFT: Final = 168
RIGHT: Final = 16
LANE: Final = 22
HIGH: Final = 13
CURVE: Final = 84
GAP: Final = 12
LEAST: Final = 2.5
"""Pixels that a pulse of one call is wide at least, so that it can be seen."""

LETTER: Final = 6.8
"""Pixels that a letter in a band takes."""

FINE: Final = 1.5
"""Pixels between two points of a curve."""

STYLE: Final = """
text { font: 12px system-ui, sans-serif; fill: #24292f }
.name { text-anchor: end }
.group { font-weight: 600 }
.small { font-size: 10.5px; fill: #57606a }
.in { stroke: #0969da; fill: #0969da22 }
.out { stroke: #1a7f37; fill: #1a7f3722 }
.bad { stroke: #cf222e; fill: #cf222e22 }
.in, .out, .bad { stroke-width: 1.5; stroke-linejoin: round }
.curve { stroke: #8250df; stroke-width: 1.6; fill: none; stroke-linejoin: round }
.rule { stroke: #d0d7de; stroke-width: 1 }
.edge { stroke: #0969da; stroke-width: 1; stroke-dasharray: 2 3; opacity: .45 }
""".strip()

SECOND: Final = """
.other { stroke: #bf8700; stroke-width: 1.6; fill: none; stroke-linejoin: round }
.second { fill: #9a6700 }"""
"""The rest of the style, where a curve has a second one beside it."""


class Lane(NamedTuple):
    """A signal that is TRUE or FALSE.

    Attributes:
        group: what it belongs to; neighbours of one group stand together.
        name: of the signal.
        kind: `in`, `out` or `bad`.
        values: per cycle.
    """

    group: str
    name: str
    kind: str
    values: Sequence[bool]


class Band(NamedTuple):
    """A signal with values that have names.

    Attributes:
        group: as of a lane.
        name: of the signal.
        kind: as of a lane.
        values: per cycle; nothing is drawn where one is empty.
        marks: kinds of values that have one of their own.
    """

    group: str
    name: str
    kind: str
    values: Sequence[str]
    marks: Mapping[str, str] = {}


class Curve(NamedTuple):
    """A number over time, or two of them in one scale.

    Attributes:
        name: with the unit.
        values: per cycle.
        other_name: of the second one.
        other: its values, drawn behind the first; empty without one.
    """

    name: str
    values: Sequence[float]
    other_name: str = ""
    other: Sequence[float] = ()


def diagram(title: str, lanes: Sequence[Lane | Band], curves: Sequence[Curve], cycle_ms: float) -> str:
    """Return the picture; all signals have a value per cycle."""
    count = len((*lanes, *curves)[0].values)
    step = (WIDTH - LEFT - RIGHT) / count
    body, y = [], 14.0
    group = ""
    for lane in lanes:
        if lane.group != group:
            y += GAP
            body.append(f'<text class="group" x="12" y="{y + 4:g}">{escape(lane.group)}</text>')
            y += 14
            group = lane.group
        body += _band(lane, y, step) if isinstance(lane, Band) else _lane(lane, y, step)
        y += LANE
    for curve in curves:
        y += GAP
        body += _curve(curve, y, step)
        y += CURVE
    edges = sorted({k for lane in lanes if lane.kind == "in" for k in _changes(lane.values)})
    lines = [f'<path class="edge" d="M{LEFT + k * step:.1f} 14V{y + 4:.1f}"/>' for k in edges]
    axis = list(_axis(count * cycle_ms, y + 4))
    size = f'viewBox="0 0 {WIDTH} {y + 34:g}" width="{WIDTH}" height="{y + 34:g}"'
    head = f'<svg xmlns="http://www.w3.org/2000/svg" {size} role="img">'
    paper = f'<rect width="{WIDTH}" height="{y + 34:g}" rx="6" fill="#ffffff"/>'
    style = STYLE + (SECOND if any(curve.other for curve in curves) else "")
    return "\n".join(
        [head, f"<title>{escape(title)}</title>", f"<style>{style}</style>", paper, *lines, *body, *axis, "</svg>", ""]
    )


def _changes(values: Sequence[object]) -> list[int]:
    return [k for k in range(1, len(values)) if values[k] != values[k - 1]]


def _lane(lane: Lane, y: float, step: float) -> Iterator[str]:
    """Yield name and waveform of a lane whose top is at y."""
    low, high = y + HIGH, y
    yield f'<text class="name" x="{LEFT - 12}" y="{low - 1:g}">{escape(lane.name)}</text>'
    path, cuts = [f"M{LEFT} {low:g}"], [0, *_changes(lane.values), len(lane.values)]
    for start, end in itertools.pairwise(cuts):
        left = LEFT + start * step
        right = max(LEFT + end * step, left + LEAST) if lane.values[start] else LEFT + end * step
        level = high if lane.values[start] else low
        path.append(f"L{left:.1f} {level:g}L{right:.1f} {level:g}")
    path.append(f"L{WIDTH - RIGHT} {low:g}")
    yield f'<path class="{lane.kind}" d="{"".join(path)}"/>'


def _band(band: Band, y: float, step: float) -> Iterator[str]:
    """Yield name and boxes of a band whose top is at y; a value stands in its box where there is room for it."""
    low = y + HIGH + 2
    yield f'<text class="name" x="{LEFT - 12}" y="{low - 3:g}">{escape(band.name)}</text>'
    for start, end in itertools.pairwise([0, *_changes(band.values), len(band.values)]):
        value, left, right = band.values[start], LEFT + start * step, LEFT + end * step
        if not value:
            continue
        kind = band.marks.get(value, band.kind)
        yield f'<path class="{kind}" d="M{left:.1f} {y:g}H{right:.1f}V{low:g}H{left:.1f}Z"/>'
        if right - left > LETTER * len(value) + 4:
            middle = (left + right) / 2
            yield f'<text class="small" x="{middle:.1f}" y="{low - 4:g}" text-anchor="middle">{escape(value)}</text>'


def _curve(curve: Curve, y: float, step: float) -> Iterator[str]:
    """Yield name, scale and course of a curve whose top is at y."""
    low, high = min(0.0, *curve.values, *curve.other), max(0.0, *curve.values, *curve.other)
    span = (high - low) or 1.0
    top, bottom = y + 8, y + CURVE - 8

    def at(value: float) -> float:
        return bottom - (value - low) / span * (bottom - top)

    middle = (top + bottom) / 2 + (-4 if curve.other else 4)
    yield f'<text class="name" x="{LEFT - 44}" y="{middle:g}">{escape(curve.name)}</text>'
    if curve.other:
        yield f'<text class="name second" x="{LEFT - 44}" y="{middle + 16:g}">{escape(curve.other_name)}</text>'
    for value in dict.fromkeys((low, 0.0, high)):
        yield f'<path class="rule" d="M{LEFT} {at(value):.1f}H{WIDTH - RIGHT}"/>'
        yield f'<text class="name small" x="{LEFT - 6}" y="{at(value) + 4:.1f}">{value:.5g}</text>'
    stride, last = max(1, round(FINE / step)), len(curve.values) - 1
    for kind, values in (("other", curve.other), ("curve", curve.values)):
        if values:
            points = " ".join(f"{LEFT + k * step:.1f},{at(values[k]):.1f}" for k in [*range(0, last, stride), last])
            yield f'<polyline class="{kind}" points="{points}"/>'


def _axis(length_ms: float, y: float) -> Iterator[str]:
    """Yield the time axis."""
    spacing = next(one for one in (5, 10, 20, 50, 100, 200, 500, 1000, 2000) if length_ms / one <= 12)
    yield f'<path class="rule" d="M{LEFT} {y:.1f}H{WIDTH - RIGHT}"/>'
    for k in range(int(length_ms // spacing) + 1):
        x = LEFT + k * spacing / length_ms * (WIDTH - LEFT - RIGHT)
        label = f"{k * spacing} ms" if k == 0 else f"{k * spacing}"
        yield f'<path class="rule" d="M{x:.1f} {y:.1f}v4"/>'
        yield f'<text class="small" x="{x:.1f}" y="{y + 17:.1f}" text-anchor="middle">{label}</text>'

"""Cost against number of axes: measured, and drawn into a page of its own."""

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any, Final, NamedTuple

from motionlayer.bench import _load, _peers
from motionlayer.bench._environment import PINS, PeersMissing
from motionlayer.bench._row import Effort
from motionlayer.bench._timing import median_us

AXES: Final = (1, 3, 10, 30, 100, 300, 1000, 3000, 10_000)
SLOWER: Final = 20
"""The peer runs so many times fewer cycles: ten thousand calls each are slow."""

SUFFIXES: Final = (".html", ".htm")


class Curve(NamedTuple):
    """Median time of a complete cycle, in µs, for every number of axes."""

    name: str
    values: list[float]


def measure(effort: Effort, tell: Callable[[str], None], axes: Sequence[int] = AXES) -> tuple[list[Curve], list[str]]:
    """Return our curve and the peer's, and a note where the peer is missing."""
    ours = []
    for count in axes:
        tell(f"cycle of {count} axes")
        with _load.moving(_load.machine(count)) as run:
            ours.append(median_us(run.step, effort.samples))
    curves = [Curve("motionlayer", ours)]
    tell("peer: pyplcopen")
    work = {"axes": list(axes), "cycles": max(3, effort.samples // SLOWER)}
    try:
        curves.append(Curve(f"pyplcopen {PINS['pyplcopen']}", _peers.ask("cycle by axes", work, effort)))
    except PeersMissing as missing:
        return curves, [f"no pyplcopen: {missing}"]
    return curves, []


def write_page(curves: Sequence[Curve], file: Path, heading: str, axes: Sequence[int] = AXES) -> None:
    """Draw the curves into one HTML file.

    Raises:
        OSError: the file cannot be written.
    """
    from plotly.offline import get_plotlyjs  # noqa: PLC0415 - a second to import, and only here

    from motionlayer.record.plot._style import FONT, SOFT  # noqa: PLC0415

    chart = _figure(curves, axes).to_html(full_html=False, include_plotlyjs=False, config={"displaylogo": False})
    style = f"body {{ margin: 0 auto; max-width: 1100px; padding: 36px; font: 14px/1.45 {FONT}; color: #1f2933; }}"
    page = [
        "<!doctype html><html lang=en><head><meta charset=utf-8><title>Cycle cost</title>",
        f"<style>{style} h1 {{ font-weight: 600; margin: 0; }} .soft {{ color: {SOFT}; }}</style>",
        f"<script>{get_plotlyjs()}</script></head><body><h1>Cost of a cycle against number of axes</h1>",
        f"<div class=soft>{heading}. All axes move; median of complete cycles, both scales logarithmic.</div>",
        chart,
        "</body></html>",
    ]
    file.write_text("\n".join(page), encoding="utf-8")


def _figure(curves: Sequence[Curve], axes: Sequence[int]) -> Any:  # noqa: ANN401 - plotly has no types
    import plotly.graph_objects as go  # noqa: PLC0415 - as above

    from motionlayer.record.plot import _style  # noqa: PLC0415

    figure = go.Figure(layout={**_style.common(), "height": 560, "margin": {"l": 76, "r": 24, "t": 28, "b": 60}})
    for curve, colour in zip(curves, _style.COLOURS, strict=False):
        figure.add_scatter(
            x=list(axes), y=curve.values, name=curve.name, mode="lines+markers", line={"color": colour, "width": 2},
            hovertemplate="%{x} axes: %{y:.3~g} µs",
        )  # fmt: skip
    figure.update_xaxes(type="log", dtick=1, title="axes", **_style.axis_style())
    figure.update_yaxes(type="log", dtick=1, title="µs per cycle", **_style.axis_style())
    figure.update_layout(legend={"x": 0.02, "y": 0.98}, hovermode="x")
    return figure

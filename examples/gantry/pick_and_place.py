"""Home a gantry, then work off a list of parts: pick, place, next.

X and Y travel together; Z leaves and arrives around them: they set off as soon as the part is clear of its
neighbours, and the gripper comes down while they still brake.
"""

import csv
from pathlib import Path
from typing import NamedTuple

from motionlayer import Simulation, all_of

TRAVEL_Z = 160.0  # height at which the gripper travels, mm
CLEAR_Z = 70.0  # above this X and Y may move
GRIP_TIME = 0.040  # to close or to open the gripper, s
PER_LINE = 10


class Spot(NamedTuple):
    """Somewhere to pick or to place, mm."""

    x: float
    y: float
    z: float


def read_positions(path: Path) -> list[tuple[Spot, Spot]]:
    """Return (pick, place) for every line of the list."""
    with path.open(newline="") as file:
        lines = [[float(value) for value in line] for line in list(csv.reader(file))[1:]]
    return [(Spot(*line[:3]), Spot(*line[3:])) for line in lines]


async def home(run: Simulation) -> None:
    """Switch all axes on and find their references: Z first, it is in the way."""
    x, y, z = (run.axes[name] for name in "XYZ")
    await all_of(x.enable(), y.enable(), z.enable())
    await z.home()
    await all_of(x.home(), y.home(), z.move_absolute(TRAVEL_Z))


async def travel(run: Simulation, spot: Spot) -> None:
    """Go from one spot to the next, up, across and down in one flow."""
    x, y, z = (run.axes[name] for name in "XYZ")
    z.move_absolute(TRAVEL_Z)
    await run.until(lambda: z.set_position > CLEAR_Z)
    across = all_of(x.move_absolute(spot.x), y.move_absolute(spot.y))
    lead = fall_time(z.config.maximum.acceleration)
    await run.until(lambda: max(x.remaining_time, y.remaining_time) < lead)
    down = z.move_absolute(spot.z)
    await all_of(across, down)
    await run.sleep(GRIP_TIME)


def fall_time(acceleration: float) -> float:
    """Return how long the gripper certainly takes from travel height down to the clear height, s."""
    return float((2.0 * (TRAVEL_Z - CLEAR_Z) / acceleration) ** 0.5)


async def pick_and_place(run: Simulation) -> None:
    """Home, work off the list, print the time of every part."""
    await home(run)
    print(f"homed after {run.time:.3f} s; seconds per part:")
    parts = read_positions(Path(__file__).with_name("positions.csv"))
    began = run.time
    times = []
    for pick, place in parts:
        start = run.time
        await travel(run, pick)
        await travel(run, place)
        times.append(run.time - start)
        if len(times) % PER_LINE == 0:
            line = " ".join(f"{seconds:.3f}" for seconds in times[-PER_LINE:])
            print(f"  {len(times) - PER_LINE + 1:3d}-{len(times):3d}  {line}")
    whole = run.time - began
    per_part = whole / len(parts)
    print(f"{len(parts)} parts in {whole:.1f} s: {per_part:.3f} s per part, {3600 / per_part:.0f} parts per hour")

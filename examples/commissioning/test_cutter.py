"""Tests of a control program without its machine. They take seconds, and give the same result on every computer."""

import numpy as np
import pytest

from motionlayer import Fault

from .conftest import Cell
from .cutter import CLEAR, LENGTH, Step

MOVES = 0.005
"""What is faster than this moves, mm per cycle; slower is a drive that settles in its target window."""


def assert_knife_up_while_material_moves(cell: Cell) -> None:
    """The rule, in every cycle, by what the encoders show."""
    trace = cell.run.trace
    moving = np.abs(np.diff(trace["Feed.actual_position"])) > MOVES
    down = trace["Knife.actual_position"][1:] > CLEAR
    at = np.flatnonzero(moving & down)
    assert at.size == 0, f"material moves under the knife at {trace.time[at[0]]:.3f} s"


def test_three_pieces_in_time(cell: Cell) -> None:
    cell.play()
    assert (cell.cutter.step, cell.cutter.cut) == (Step.FINISHED, 3)
    assert cell.run.axes["Feed"].set_position == 3 * LENGTH
    assert cell.run.time < 3.0
    assert_knife_up_while_material_moves(cell)


@pytest.mark.parametrize("axis", ["Feed", "Knife"])
@pytest.mark.parametrize("kind", ["drive_error", "lost_enable", "lost_communication", "blocked"])
@pytest.mark.parametrize("time", [0.05, 0.2, 0.35, 0.5, 0.6, 0.7])
def test_a_fault_at_any_moment_costs_time_and_no_piece(cell: Cell, axis: str, kind: str, time: float) -> None:
    cell.run.inject(axis, Fault(kind, duration=0.02), tick=cell.run.tick + round(time * 1000))
    cell.play()
    assert (cell.cutter.step, cell.cutter.cut) == (Step.FINISHED, 3)
    assert_knife_up_while_material_moves(cell)


def test_a_drive_that_stays_broken_is_an_alarm(cell: Cell) -> None:
    for tick in range(400, 2000, 50):
        cell.run.inject("Knife", Fault("drive_error"), tick=tick)
    cell.play()
    assert cell.cutter.step is Step.ALARM
    assert_knife_up_while_material_moves(cell)

"""Enumerations of the interface against the tables of motion-layer 2, and the numbers that lead into the NC."""

import pytest

from motionlayer import nc
from motionlayer.layer import types

from .enumerations import TABLES

ALL = {one.name: one for one in types.ENUMERATIONS + types.LIBRARY_ENUMERATIONS}


def test_every_enumeration_of_the_tables_exists_and_no_other() -> None:
    assert set(ALL) == set(TABLES)
    assert len(ALL) == len(types.ENUMERATIONS + types.LIBRARY_ENUMERATIONS)


@pytest.mark.parametrize("name", TABLES)
def test_base_and_members(name: str) -> None:
    kind = ALL[name]
    base, members = TABLES[name]
    assert kind.base.name == base
    told = dict(one.split("=") for one in members.split())
    assert {declared: str(int(value)) for declared, value in kind.items} == told
    assert all(kind.iec_name(int(number)) == declared for declared, number in told.items())


def test_an_unknown_number_is_its_own_name() -> None:
    assert types.E_AXIS_ENCODER_TYPE.iec_name(29) == "29"
    assert types.E_AXIS_CTRL.iec_name(9) == "9"


@pytest.mark.parametrize("mode", types.BufferMode)
def test_every_buffer_mode_leads_into_the_nc(mode: types.BufferMode) -> None:
    assert types.NC_BUFFER_MODES[mode].name == mode.name


def test_modes_of_homing_that_the_nc_knows() -> None:
    assert set(types.NC_CALIBRATIONS.values()) == set(nc.Calibration)

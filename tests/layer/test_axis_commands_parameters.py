"""Parameters by the command field of an axis (motion-layer 5.11)."""

from typing import Any

import pytest

from motionlayer.command import ErrorId
from motionlayer.layer import AxisCommand, Progress
from tests.layer.rig import FAILED, Rig

C, P = AxisCommand, Progress


def test_d02_a_persistent_write_is_carried_out(tmp_path: Any) -> None:
    rig = Rig(top={"persistent_file": str(tmp_path / "kept.toml")})
    rig.x.nc_parameter_in.number, rig.x.nc_parameter_in.value = 1004, 1234.0
    assert rig.do(C.PARAMETER_WRITE_PERSISTENT) == [P.INIT, P.OCCUPIED, P.WORKING, P.DONE]
    assert rig.run.axes["X"].config.default.acceleration == 1234.0
    assert "1234" in (tmp_path / "kept.toml").read_text()


def test_parameters_are_read_and_written() -> None:
    rig = Rig()
    asked, out = rig.x.nc_parameter_in, rig.x.nc_parameter_out
    asked.number, asked.value = 1004, 2000.0
    assert rig.do(C.PARAMETER_WRITE) == [P.INIT, P.OCCUPIED, P.WORKING, P.DONE]
    assert (out.number, out.value) == (1004, 2000.0)
    asked.value = 0.0
    assert rig.do(C.PARAMETER_READ) == [P.INIT, P.OCCUPIED, P.WORKING, P.DONE]
    assert (out.number, out.value) == (1004, 2000.0)
    asked.number = 1016
    rig.do(C.NULL)
    rig.do(C.PARAMETER_READ)
    assert (out.number, out.value) == (1016, 1.0), "TRUE travels as 1.0"


def test_number_and_value_are_latched_with_the_command() -> None:
    rig = Rig()
    rig.x.nc_parameter_in.number, rig.x.nc_parameter_in.value = 1004, 2000.0
    rig.drop(C.PARAMETER_WRITE)
    rig.x.nc_parameter_in.number, rig.x.nc_parameter_in.value = 1005, 3.0
    rig.until(lambda: rig.x.state.code == 10041)
    assert (rig.x.nc_parameter_out.number, rig.x.nc_parameter_out.value) == (1004, 2000.0)


@pytest.mark.parametrize(("number", "value"), [(0, 1.0), (1234, 1.0), (1000, 1.0), (1004, -1.0), (1016, 0.5)])
def test_a_parameter_that_cannot_be_written_is_an_error(number: int, value: float) -> None:
    rig = Rig()
    rig.x.nc_parameter_in.number, rig.x.nc_parameter_in.value = number, value
    assert rig.do(C.PARAMETER_WRITE) == FAILED
    assert rig.x.info.error_id in (ErrorId.COMMAND_NOT_PERMITTED, ErrorId.PARAMETER)

import pytest

from motionlayer.cli import ExitCode
from motionlayer.command import ErrorId
from motionlayer.connect.ads import MEANINGS
from motionlayer.connect.ads._codes import Code
from tests.cli.support import call


@pytest.mark.parametrize("text", ["0x4225", "0X4225", "16933", "NOT_READY_AT_START", "not-ready-at-start"])
def test_an_error_is_found_by_number_and_name(text: str) -> None:
    done = call("error", text)
    assert done.exit_code == ExitCode.OK
    assert done.stdout.splitlines() == [
        "0x4225 (16933) NOT_READY_AT_START: the drive was not ready at the start",
        "  what to do   enable the drive and wait until it is ready; mend its error first, if it has one",
        "  answered by  moves that begin before the drive is ready",
        "  range        group and set-point generation, 0x4200 to 0x42FF",
    ]


def test_several_at_once() -> None:
    blocks = call("error", "0x4225", "0x4A05").stdout.split("\n\n")
    assert [block.split()[0] for block in blocks] == ["0x4225", "0x4A05"]
    assert "nothing in this version" in blocks[1]


def test_every_error_is_explained() -> None:
    done = call("error", *map(hex, ErrorId))
    assert done.stdout == call("error", *(error.name for error in ErrorId)).stdout
    heads = [block.split(": ")[0] for block in done.stdout.split("\n\n")]
    assert heads == [f"0x{error:04X} ({int(error)}) {error.name}" for error in ErrorId]


@pytest.mark.parametrize(
    ("text", "meant"),
    [
        ("4225", "4225 is no error: did you mean 0x4225, NOT_READY_AT_START?"),
        ("0x4291", "0x4291 is no error: did you mean 0x4290, BRAKING_ALREADY?"),
        ("buffer_ful", "'buffer_ful' is no error: did you mean BUFFER_FULL?"),
        ("0x42zz", "'0x42zz' is no error: give 0x4225, 16933 or a name"),
        ("99999999999999999999", "is no error: give 0x4225, 16933 or a name"),
        ("0x9999", "0x9999 is no error: give 0x4225, 16933 or a name; docs/errors.md lists all"),
        ("9999", "9999 is no error: give"),
        ("2", "2 is no error: give"),
    ],
)
def test_an_unknown_one_names_the_nearest(text: str, meant: str) -> None:
    done = call("error", "0x4225", text)
    assert done.exit_code == ExitCode.USAGE
    assert done.stdout == ""
    assert meant in done.stderr


@pytest.mark.parametrize("text", ["0x745", "1861"])
def test_ads_codes_are_explained(text: str) -> None:
    lines = call("error", text).stdout.splitlines()
    assert lines == [
        "0x0745 (1861) ADS return code: time-out",
        "  what to do   nobody listens there, or the run is not stepped: motionlayer run … --realtime --ads",
    ]


def test_every_code_that_the_server_sends_is_explained() -> None:
    assert set(Code) - set(MEANINGS) == {Code.NO_ERROR}
    done = call("error", *map(str, MEANINGS))
    assert done.exit_code == ExitCode.OK
    assert done.stdout.count("ADS return code") == len(MEANINGS)


@pytest.mark.parametrize(
    ("number", "told"),
    [
        (9012, "AXIS_MOVE_POS + PROGRESS_ERROR: AXIS_MOVE_POS failed\n  what to do   read nErrorId"),
        (10002, "AXIS_DISABLE + PROGRESS_DONE: AXIS_DISABLE is done"),
        (150, "AXIS_GEAR_IN + PROGRESS_NOT_EXIST: AXIS_GEAR_IN is not built"),
        (6012, "AXIS_MOVE_POS + PROGRESS_OCCUPIED: AXIS_MOVE_POS is under way"),
    ],
)
def test_a_state_is_told_from_an_error(number: int, told: str) -> None:
    assert call("error", number).stdout.startswith(f"{number} is a state and no error: {told}")


def test_none_is_a_usage_error() -> None:
    assert call("error").exit_code == ExitCode.USAGE

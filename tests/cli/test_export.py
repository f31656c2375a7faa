from pathlib import Path

import pytest

from motionlayer.cli import ExitCode
from motionlayer.iec.export import Declarations, c_header, csharp, structured_text, twincat
from motionlayer.machine import Machine, Simulation, interface
from tests.cli.support import MACHINE, call

LAYER = "\n[layer]\nmax_r_para = 20\n"


def declared(machine: Path) -> Declarations:
    with Simulation(Machine.load(machine)) as run:
        return interface(run)


@pytest.fixture
def layered(machine: Path) -> Path:
    machine.write_text(MACHINE + LAYER, encoding="utf-8")
    return machine


def test_declarations_go_to_stdout(layered: Path) -> None:
    done = call("export", layered, "--c")
    assert done.exit_code == ExitCode.OK
    (header,) = c_header(declared(layered)).values()
    assert done.stdout == header


def test_declarations_go_into_a_folder_with_the_sizes_of_the_machine(layered: Path, tmp_path: Path) -> None:
    folder = tmp_path / "not" / "there"
    for _ in range(2):  # of another version, they are replaced
        done = call("export", layered, "--st", "--out", folder)
        assert done.exit_code == ExitCode.OK
    files = twincat(declared(layered))
    assert {name: (folder / name).read_text(encoding="utf-8") for name in files} == files
    assert done.stdout.splitlines()[-1] == f"written {folder / 'POUs'}: 3 files"
    assert "Ctrl AT %Q* : ARRAY [1..1] OF ST_AXIS_CTRL;" in files["GVLs/GVL_AXIS.TcGVL"]
    assert "_rValue : ARRAY [0..20] OF LREAL;" in files["DUTs/ST_R_Parameter.TcDUT"]


def test_printed_text_has_everything(layered: Path) -> None:
    done = call("export", layered, "--st")
    assert done.exit_code == ExitCode.OK
    assert done.stdout == "\n".join(structured_text(declared(layered)).values())


def test_all_languages_go_into_one_folder(layered: Path, tmp_path: Path) -> None:
    assert call("export", layered, "--st", "--c", "--csharp", "--out", tmp_path).exit_code == ExitCode.OK
    assert {one.name for one in tmp_path.iterdir() if one.name != "machine.toml"} >= {
        "motion_layer.h",
        "MotionLayer.cs",
        "DUTs",
        "GVLs",
        "POUs",
        "libraries",
    }


def test_what_clients_are_told_to_use_is_declared(layered: Path) -> None:
    """Faults of drives, message lists, and the objects with methods stand beside the layer."""
    text = call("export", layered, "--st").stdout
    for line in (
        "    DriveFault AT %Q* : ARRAY [1..1] OF ST_DRIVE_FAULT;",
        "    MotionMessages : ARRAY [1..200] OF ST_Message;",
        "    Axis : ARRAY [1..1] OF FB_MOTION_AXIS;",
        "FUNCTION F_StateCommand : UINT",
        "FUNCTION F_StateProgress : UINT",
        "FUNCTION_BLOCK FB_MotionLayerAds",
    ):
        assert f"\n{line}" in text


def test_csharp_has_its_file(layered: Path, tmp_path: Path) -> None:
    assert call("export", layered, "--csharp", "--out", tmp_path).exit_code == ExitCode.OK
    assert (tmp_path / "MotionLayer.cs").read_text(encoding="utf-8").startswith("// motionlayer: interface of one")


def test_a_control_side_has_the_same_interface(machine: Path) -> None:
    machine.write_text('format = 1\nname = "plc"\n[control]\naxes = ["X", "Y"]\n', encoding="utf-8")
    done = call("export", machine, "--st")
    assert done.exit_code == ExitCode.OK
    assert "Ctrl AT %Q* : ARRAY [1..2] OF ST_AXIS_CTRL;" in done.stdout


@pytest.mark.parametrize("asked", ["", "switches = true\n"])
def test_limit_switches_are_an_image_where_that_is_asked_for(machine: Path, asked: str) -> None:
    machine.write_text(f'format = 1\nname = "plc"\n[control]\naxes = ["X"]\n{asked}', encoding="utf-8")
    place = " AT %Q*" if asked else ""
    text = call("export", machine, "--st").stdout
    assert f"\n    LimitSwitches{place} : ARRAY [1..1] OF ST_AXIS_LIMIT_SWITCHES;" in text
    assert ("sSymbol := 'GVL_AXIS.LimitSwitches'" in text) is bool(asked)


def test_what_holds_switches_on_the_motion_side_is_an_image_on_the_other(layered: Path) -> None:
    layered.write_text(MACHINE + LAYER + '[layer.map.all]\ngroup = "axis"\nswitches = true\n', encoding="utf-8")
    assert "\n    LimitSwitches AT %Q* : ARRAY [1..1] OF" in call("export", layered, "--st").stdout


def test_references_begin_with_those_of_the_machine_file(machine: Path) -> None:
    """A controller that writes the whole variable changes none of them."""
    two = MACHINE + MACHINE[MACHINE.index("[axis.") :].replace("[axis.X", "[axis.Y")
    machine.write_text(f"{two}[axis.Y.home]\nposition = -12.5\n{LAYER}", encoding="utf-8")
    told = declared(machine)
    text = structured_text(told)["motion_layer.st"]
    starts = ", ".join(f"(stHomingParam := (Position := {one}))" for one in (0.0, -12.5))
    assert f"    HomeParameter AT %Q* : ARRAY [1..2] OF ST_HOMING := [{starts}];" in text
    (header,) = c_header(told).values()
    assert header.count(".Position = -12.5, .Options = ST_HomingOptions_INIT, .UseLimitMin = 1, .UseLimitMax = 1") == 1
    (source,) = csharp(told).values()
    assert "public static ST_HOMING[] CreateHomeParameter() => new ST_HOMING[] {" in source
    with Simulation(Machine.load(machine)) as run:
        assert [run.symbols.read(f"GVL_AXIS.HomeParameter[{at}].stHomingParam.Position") for at in (1, 2)] == [0, -12.5]


def test_references_at_zero_need_no_start_values(layered: Path) -> None:
    assert (
        "    HomeParameter AT %Q* : ARRAY [1..1] OF ST_HOMING;" in structured_text(declared(layered))["motion_layer.st"]
    )


def test_types_have_the_names_of_the_slides_too(layered: Path) -> None:
    text = structured_text(declared(layered))["motion_layer.st"]
    for name, other in (("ST_CTRL_NCI", "ST_NCI_CTRL"), ("ST_STATE_NCI", "ST_NCI_STATE")):
        assert f"\nTYPE {name} : {other};\nEND_TYPE\n" in text
        assert text.index(f"TYPE {other} :") < text.index(f"TYPE {name} :")


NAMESPACE = """
import enum

from motionlayer.iec import UINT, Enumeration, Field, Struct
from motionlayer.layer import Namespace


class Command(enum.IntEnum):
    NULL = 0
    FILL = 30


class Ctrl(Struct, iec="ST_TANK_CTRL", pack=2):
    cmd = Field("eCmd", Enumeration("E_TANK_CTRL", UINT, Command, prefix="TANK_"), "what to do")


class State(Struct, iec="ST_TANK_STATE", pack=2):
    state = Field("eState", UINT, "how far it is")


async def main(run):
    print("declaring")
    run.namespaces.add_array(Namespace("GVL_TANK", Ctrl, State, {}, source="Brewery"), ["north", "south"])
    run.namespaces.add(Namespace("GVL_LID", Ctrl, State, {}), mapped=True)
    await run.sleep(100.0)
"""


def with_program(layered: Path, text: str) -> Path:
    (layered.parent / "tanks.py").write_text(text, encoding="utf-8")
    lines = layered.read_text(encoding="utf-8")
    layered.write_text(lines + '[program.main]\nfile = "tanks.py"\n', encoding="utf-8")
    return layered


@pytest.mark.parametrize(
    ("language", "texts"),
    [
        (
            "--st",
            [
                "TYPE E_TANK_CTRL :",
                "    TANK_FILL := 30",
                "    eCmd : E_TANK_CTRL; // what to do",
                "// Global variable list GVL_TANK",
                "    Ctrl : ARRAY [1..2] OF ST_TANK_CTRL; // command of Brewery",
                "    State : ARRAY [1..2] OF ST_TANK_STATE; // state of Brewery",
                "    Ctrl AT %Q* : ST_TANK_CTRL; // command of GVL_LID",
                "    State AT %I* : ST_TANK_STATE; // state of GVL_LID",
            ],
        ),
        (
            "--c",
            [
                "    E_TANK_CTRL_TANK_FILL = 30,",
                "MOTION_LAYER_CHECK(sizeof(ST_TANK_CTRL) == 2);",
                "typedef ST_TANK_CTRL GVL_TANK_Ctrl[2];",
                '#define GVL_LID_State_SYMBOL "GVL_LID.State"',
            ],
        ),
        (
            "--csharp",
            [
                "public enum E_TANK_CTRL : ushort",
                "public struct ST_TANK_STATE",
                'Symbol("GVL_TANK.Ctrl", typeof(ST_TANK_CTRL), 2, 4, Side.Symbol)',
                'Symbol("GVL_LID.State", typeof(ST_TANK_STATE), 1, 2, Side.Reads)',
            ],
        ),
    ],
)
def test_namespaces_of_ones_own_are_declared_too(layered: Path, language: str, texts: list[str]) -> None:
    done = call("export", with_program(layered, NAMESPACE), language)
    assert done.exit_code == ExitCode.OK
    assert [text for text in texts if text not in done.stdout] == []
    assert "declaring" in done.stderr
    assert "declaring" not in done.stdout


def test_a_program_that_fails_may_not_have_declared_everything(layered: Path) -> None:
    done = call("export", with_program(layered, "async def main(run):\n    1 / 0\n"), "--st")
    assert done.exit_code == ExitCode.FAILED
    assert "program main: ZeroDivisionError: division by zero" in done.stderr
    assert done.stdout == ""


def test_a_program_that_is_not_there_could_have_declared_something(layered: Path) -> None:
    file = with_program(layered, "")
    (layered.parent / "tanks.py").unlink()
    done = call("export", file, "--st")
    assert done.exit_code == ExitCode.FAILED
    assert "tanks.py" in done.stderr


def test_a_language_must_be_said(layered: Path) -> None:
    done = call("export", layered)
    assert done.exit_code == ExitCode.USAGE
    assert "say which language: --st, --c, --csharp; with --out more than one of them" in done.stderr


def test_languages_are_not_printed_as_one(layered: Path) -> None:
    done = call("export", layered, "--st", "--c")
    assert done.exit_code == ExitCode.USAGE
    assert "several languages cannot be printed as one: choose one, or give --out FOLDER" in done.stderr


def test_a_machine_without_a_motion_layer(machine: Path) -> None:
    done = call("export", machine, "--st")
    assert done.exit_code == ExitCode.FAILED
    assert done.stderr == "Error: one has no motion layer: add [layer] to the machine file, or [control]\n"


def test_a_folder_that_cannot_be_made(layered: Path, tmp_path: Path) -> None:
    (tmp_path / "taken").write_text("a file")
    done = call("export", layered, "--st", "--out", tmp_path / "taken")
    assert done.exit_code == ExitCode.OUTPUT
    assert "cannot be written" in done.stderr


def test_a_file_that_cannot_be_written(layered: Path, tmp_path: Path) -> None:
    (tmp_path / "motion_layer.h").mkdir()
    done = call("export", layered, "--c", "--out", tmp_path)
    assert done.exit_code == ExitCode.OUTPUT
    assert f"{tmp_path / 'motion_layer.h'} cannot be written" in done.stderr

import sys
from pathlib import Path

from tests.cli.support import python

import motionlayer.machine

MACHINE = 'format = 1\nname = "plain"\n[axis.X]\nmax_velocity = 1.0\nmax_acceleration = 1.0\nmax_jerk = 1.0\n'
ABSENT = ("asyncio", "plotly", "motionlayer.connect.ads", "motionlayer.iec", "motionlayer.layer", "motionlayer.verify")


def imported(code: str) -> set[str]:
    done = python("-c", f"import sys\n{code}\nprint(*sys.modules)", MOTIONLAYER_KERNELS="plain")
    assert done.returncode == 0, done.stderr
    return set(done.stdout.splitlines()[-1].split())


def test_a_run_loads_neither_the_motion_layer_nor_servers_that_its_machine_has_not(tmp_path: Path) -> None:
    machine = tmp_path / "machine.toml"
    machine.write_text(MACHINE, encoding="utf-8")
    run = f"from motionlayer import Machine, Simulation\nwith Simulation(Machine.load({str(machine)!r})) as run:\n"
    plain = imported(run + "    run.run(time=0.01)")
    assert "motionlayer.machine._simulation" in plain
    assert plain.isdisjoint(ABSENT)
    machine.write_text(f"{MACHINE}[layer]\n[ads]\nport = 0\n", encoding="utf-8")
    assert imported(run + "    run.step()") >= {"asyncio", "motionlayer.connect.ads", "motionlayer.layer"}


def test_everything_the_package_names_can_be_imported() -> None:
    for name in motionlayer.machine.__all__:
        assert getattr(motionlayer.machine, name) is not None
    assert not hasattr(motionlayer.machine, "AdsLnk")
    assert "motionlayer.machine._ads_link" in sys.modules

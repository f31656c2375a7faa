"""Cut pieces to length: the feed brings material, the blade cuts. In the manner of a PLC: no waits, a step chain."""

from types import SimpleNamespace

from motionlayer import Simulation
from motionlayer.fb import MC_Home, MC_MoveAbsolute, MC_MoveRelative, MC_Power, MC_Reset

LENGTH = 120.0  # mm
PIECES = 5


def setup(run: Simulation, memory: SimpleNamespace) -> None:
    """Make the blocks; `memory` keeps them from call to call."""
    memory.feed, memory.blade = feed, blade = run.axis_refs["Feed"], run.axis_refs["Blade"]
    memory.power = [MC_Power(feed), MC_Power(blade)]
    memory.reset = [MC_Reset(feed), MC_Reset(blade)]
    memory.home = MC_Home(blade)
    memory.bring = MC_MoveRelative(feed)
    memory.down, memory.up = MC_MoveAbsolute(blade), MC_MoveAbsolute(blade)
    memory.step, memory.pieces = "power", 0


def chain(m: SimpleNamespace) -> str:  # noqa: PLR0911 - one return per transition
    """Return the next step."""
    if any(ref.ReadStatus().Error for ref in (m.feed, m.blade)):
        return "reset"
    match m.step:
        case "power" if all(power.Status for power in m.power):
            return "lift" if m.blade.Status.Homed else "home"
        case "home" if m.home.Done:
            return "lift"
        case "lift" if m.up.Done:
            return "bring" if m.pieces < PIECES else "end"
        case "bring" if m.bring.Done:
            return "cut"
        case "cut" if m.down.Done:
            m.pieces += 1
            print(f"piece {m.pieces} of {LENGTH:g} mm")
            return "lift"
        case "reset" if all(reset.Done for reset in m.reset):
            return "power"
    return str(m.step)


def main(run: Simulation, memory: SimpleNamespace) -> None:
    """Take a step of the chain where its condition holds, then call every block once, in every cycle."""
    m = memory
    if run.tick == 0:
        setup(run, m)
    m.step = chain(m)
    for power in m.power:
        power(Enable=m.step != "end", Enable_Positive=True, Enable_Negative=True)
    for reset in m.reset:
        reset(Execute=m.step == "reset")
    m.home(Execute=m.step == "home")
    m.bring(Execute=m.step == "bring", Distance=LENGTH, Velocity=500.0)
    m.down(Execute=m.step == "cut", Position=-60.0, Velocity=200.0)
    m.up(Execute=m.step == "lift", Position=20.0, Velocity=300.0)
    if m.step == "end" and not any(power.Status for power in m.power):
        run.program.cancel()

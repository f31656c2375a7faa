"""Variables belong to a run: a copy of it holds them, and puts them back into the same objects."""

from motionlayer.iec import InputArray, OutputArray, SymbolTable
from motionlayer.runtime.copying import Copies
from tests.iec.declared import AxisCtrl, Everything, Overlay


def test_variables_are_copied_and_put_back() -> None:
    inputs = InputArray(Everything, 1, 2, "GVL.In")
    outputs = OutputArray(Everything, 1, 2, "GVL.Out")
    unions = InputArray(Overlay, None, None, "GVL.Union")
    symbols = SymbolTable()
    for name, source in (("GVL.In", inputs), ("GVL.Out", outputs), ("GVL.Union", unions)):
        symbols.add(name, source)

    def state() -> list[bytes]:
        return [*map(bytes, inputs), bytes(outputs.memory), bytes(inputs.memory), bytes(unions.value)]

    inputs[1].number = 5
    first, view = inputs[1], outputs[2]
    view.ctrl.cmd = 12
    copies = Copies([("symbols", symbols)], [])
    held = state()
    inputs[1].ratios[2] = 9.0
    inputs[2] = Everything(name="other")
    view.table[1, 1] = AxisCtrl(cmd=31)
    unions.value.ctrl.progress = 1
    inputs.take()
    inputs.publish()
    copies.put_back()
    assert held == [
        bytes(inputs[1]),
        bytes(inputs[2]),
        bytes(outputs.memory),
        bytes(inputs.memory),
        bytes(unions.value),
    ]
    assert inputs[1] is first
    assert outputs[2] is view
    assert inputs.take() == [1]
    inputs.publish()
    assert inputs.memory == bytes(inputs[1]) + bytes(inputs[2])
    first.number = 6
    assert inputs.take() == [1]

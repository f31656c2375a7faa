"""`Namespaces`: everything that control programs of a run have declared, with symbols and images.

Objects are called after the programs and before MAIN, so that what their jobs tell the axes is answered in the same
cycle. A cycle in which nothing is asked and nothing is under way costs a test per namespace.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any, Final, Generic, NamedTuple, TypeVar

from motionlayer.command import Ledger
from motionlayer.iec import InputArray, OutputArray, Struct, SymbolTable
from motionlayer.iec.export import Variable, VariableList
from motionlayer.layer._answer import ObjectState, Waits
from motionlayer.layer._mapping import ImageMapping, InputProgram, OutputProgram
from motionlayer.layer._mapping_build import Outside
from motionlayer.layer._mapping_image import CommandImage, Elements, OutputImage, Port
from motionlayer.layer._namespace import Namespace, NamespaceJob, NamespaceObject, Site
from motionlayer.layer._namespace_controller import NamespaceController
from motionlayer.layer._namespace_running import RunningNamespace
from motionlayer.layer._objects import Objects
from motionlayer.layer._options import Schedule
from motionlayer.layer._ownership import Access, Ownership
from motionlayer.runtime import Guest, Stage, Step

C = TypeVar("C", bound=Struct)
S = TypeVar("S", bound=Struct)

ALWAYS: Final = Schedule()

_CTRL: Final = "command of {}"
_STATE: Final = "state of {}"
"""What a symbol says of itself."""


class _Variables(NamedTuple, Generic[C, S]):
    """Where the objects of one namespace lie."""

    ctrl: InputArray[C]
    state: OutputArray[S]
    mapped: bool


class Namespaces(Mapping[str, Namespace[Any, Any]]):
    """All namespaces that programs have declared, by name.

    Args:
        symbols: where their variables get names.
        outside: where their images lie.
        ledger: the present tick, and who commands.
        cycle_ns: length of a tick, ns.
        guest: names the code of an object in messages: `GVL_TRANSPORT`, or `GVL_TRANSPORT[2]`.

    Attributes:
        mappings: the images of those that are mapped, by name; buses attach there.
    """

    def __init__(
        self,
        symbols: SymbolTable,
        outside: Outside,
        ledger: Ledger,
        cycle_ns: int,
        guest: Callable[[str], Guest],
    ) -> None:
        self._symbols = symbols
        self._outside = outside
        self._ledger = ledger
        self._cycle_ns = cycle_ns
        self._guest = guest
        self._access = Access(outside.events, ledger)
        self._declared: dict[str, Namespace[Any, Any]] = {}
        self._variables: dict[str, _Variables[Any, Any]] = {}
        self._running: list[RunningNamespace] = []
        self.mappings: dict[str, ImageMapping] = {}

    def __getitem__(self, name: str) -> Namespace[Any, Any]:
        if name not in self._declared:
            raise KeyError(f"no namespace {name!r}; this run has {', '.join(self._declared) or 'none'}")
        return self._declared[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._declared)

    def __len__(self) -> int:
        return len(self._declared)

    def add(
        self,
        namespace: Namespace[C, S],
        job: Callable[[Site[C, S]], NamespaceJob[C, S]] = NamespaceJob,
        *,
        schedule: Schedule = ALWAYS,
        mapped: bool = False,
    ) -> NamespaceObject[C, S]:
        """Make one object of a namespace; until the first tick has ended, since symbols do not change in a run.

        Args:
            namespace: the declaration.
            job: makes the memory of the object.
            schedule: in which ticks it is called.
            mapped: its command belongs to an image, `NAME_in.Ctrl`, and its state is copied to `NAME_out.State`.

        Returns:
            What programs use.

        Raises:
            RuntimeError: the first tick has ended.
            ValueError: there is a namespace, a symbol or a type of this name already.
        """
        made = self._make(namespace, [namespace.name], job, schedule, single=True, mapped=mapped)
        return made[0]

    def add_array(
        self,
        namespace: Namespace[C, S],
        names: Sequence[str],
        job: Callable[[Site[C, S]], NamespaceJob[C, S]] = NamespaceJob,
        *,
        schedule: Schedule = ALWAYS,
        mapped: bool = False,
    ) -> Objects[NamespaceObject[C, S]]:
        """Make several objects, with indices from 1; see `add`.

        Args:
            namespace: the declaration.
            names: of the objects, in the order of their indices.
            job: makes the memory of each object.
            schedule: in which ticks they are called.
            mapped: as of `add`, of all objects.
        """
        if not names or len(set(names)) != len(names):
            raise ValueError(f"{namespace.name}: names {list(names)}: give at least one, and none twice")
        made = self._make(namespace, names, job, schedule, single=False, mapped=mapped)
        return Objects(namespace.name, {one.name: one for one in made})

    @property
    def ports(self) -> Iterator[Port]:
        """What belongs to buses, and not into a snapshot."""
        return (port for mapping in self.mappings.values() for port in mapping.ports)

    def exported(self) -> list[VariableList]:
        """Return the variables as a control side declares them: images where they are mapped, else by symbol."""
        return [
            VariableList(
                name,
                [
                    Variable("Ctrl", ctrl.type, _CTRL.format(self[name].speaker), True if mapped else None),
                    Variable("State", state.type, _STATE.format(self[name].speaker), False if mapped else None),
                ],
            )
            for name, (ctrl, state, mapped) in self._variables.items()
        ]

    def stages(self) -> Sequence[Stage]:
        """Return what a tick calls, before the stages of the layer."""
        return [
            Stage(Step.INPUTS, "namespaces in", self._copy_in),
            Stage(Step.LAYER, "namespaces", self._call),
            Stage(Step.OUTPUTS, "namespaces out", self._copy_out),
        ]

    def _make(
        self,
        namespace: Namespace[C, S],
        names: Sequence[str],
        job: Callable[[Site[C, S]], NamespaceJob[C, S]],
        schedule: Schedule,
        *,
        single: bool,
        mapped: bool,
    ) -> list[NamespaceObject[C, S]]:
        self._require_free(namespace.name)
        low, high = (None, None) if single else (1, len(names))
        variables = _Variables(
            InputArray(namespace.ctrl, low, high, f"{namespace.name}.Ctrl"),
            OutputArray(namespace.state, low, high, f"{namespace.name}.State"),
            mapped,
        )
        for variable, comment in ((variables.ctrl, _CTRL), (variables.state, _STATE)):
            self._symbols.add(variable.name, variable, comment=comment.format(namespace.speaker))
        owned = self._map(namespace.name, variables) if mapped else {}
        Ownership(variables.ctrl, owned, self._access, command=True)
        sites = [
            Site(namespace, 0 if single else place + 1, ctrl, state, self._ledger, self._outside.events, self._cycle_ns)
            for place, (ctrl, state) in enumerate(zip(variables.ctrl, variables.state, strict=True))
        ]
        controllers = [
            NamespaceController(job(site), place, self._guest(f"{namespace.name}{'' if single else f'[{place + 1}]'}"))
            for place, site in enumerate(sites)
        ]
        waits = Waits()
        self._declared[namespace.name] = namespace
        self._variables[namespace.name] = variables
        self._running.append(RunningNamespace(variables.ctrl, controllers, schedule, waits))
        return [
            NamespaceObject(one.memory.index, name, one.memory.ctrl, _state_of(name, one, waits))
            for name, one in zip(names, controllers, strict=True)
        ]

    def _require_free(self, name: str) -> None:
        if self._ledger.tick > 0:
            raise RuntimeError(f"namespace {name}: declare it before the end of the first tick")
        if name in self._declared:
            raise ValueError(f"namespace {name}: there is one already")

    def _map(self, name: str, variables: _Variables[Any, Any]) -> Mapping[int | None, str]:
        """Make the images of a namespace, and return which of them owns each command."""
        areas, mailbox, events = self._outside
        places = range(len(variables.ctrl))
        size = len(places)
        into = areas.add(f"{name}_in.Ctrl", variables.ctrl.size * size, outside=True)
        out = areas.add(f"{name}_out.State", variables.state.size * size)
        image = CommandImage(into, variables.ctrl, places, written=True)
        shown = OutputImage(out, Elements(variables.state, places))
        self.mappings[name] = ImageMapping(
            [InputProgram(f"{name}_in", [image], events, mailbox)], [OutputProgram(f"{name}_out", [shown], events)]
        )
        return dict.fromkeys(image.indices, image.name)

    def _copy_in(self, tick: int) -> None:
        for mapping in self.mappings.values():
            mapping.copy_in(tick)

    def _call(self, tick: int) -> None:
        for one in self._running:
            one.call(tick)

    def _copy_out(self, tick: int) -> None:
        for mapping in self.mappings.values():
            mapping.copy_out(tick)


def _state_of(name: str, controller: NamespaceController, waits: Waits) -> ObjectState:
    memory = controller.memory
    members = memory.site.namespace.commands.members
    return ObjectState(name, members, controller.asked, memory.state, lambda: memory.error, waits)

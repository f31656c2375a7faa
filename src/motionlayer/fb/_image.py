"""`Image`: one element of the cyclic interface of the NC."""

from collections.abc import Iterable
from typing import Any, NoReturn

import numpy as np


class Image:
    """One element of the cyclic interface: its fields are attributes with the names of the interface.

    Reading gives numbers of Python; writing is for the side that owns the direction.
    """

    __slots__ = ("_record",)

    _record: np.ndarray[Any, Any]

    def __init__(self, record: np.ndarray[Any, Any]) -> None:
        object.__setattr__(self, "_record", record)

    def __getattr__(self, name: str) -> Any:  # noqa: ANN401 - of the type of the field
        try:
            return self._record[name].tolist()
        except ValueError:
            self._refuse(name)

    def __setattr__(self, name: str, value: object) -> None:
        try:
            self._record[name] = value
        except ValueError:
            self._refuse(name)

    def __dir__(self) -> Iterable[str]:
        return (*super().__dir__(), *self._fields)

    def __repr__(self) -> str:
        shown = [f"{name}={self._record[name].tolist()}" for name in self._fields if self._record[name].any()]
        return f"<{' '.join(['Image', *shown])}>"

    @property
    def _fields(self) -> tuple[str, ...]:
        return self._record.dtype.names or ()

    def _refuse(self, name: str) -> NoReturn:
        raise AttributeError(f"no field {name}; there are {', '.join(self._fields)}") from None

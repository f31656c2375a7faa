"""Copies of all that can change behind some objects, to be put back in place.

From its roots a copy follows every reference. Each object that can change is noted once, with a shallow copy of what it
holds, and `put_back` writes that into *the same* object. So identities survive: a command that an axis executes is the
one that a program keeps in its memory and that a closure watches, before and after, and whoever holds a reference to
any of them holds the right one. Pickling would make others, and closures cannot be pickled at all.

What is not followed: immutable values, classes and modules, what is pinned, and the closures of functions outside of
this package: a program's own code belongs to whoever wrote it. A class says `UNCHANGING = True` if its objects never
change, nor anything that they hold: descriptions, of which there may be thousands. What can change in a way that
Python cannot see, a file or a running generator, is refused by its path from the root.

Order does not matter: what is put back holds references, and none of it is looked at on the way.
"""

from motionlayer.runtime.copying._copies import Copies
from motionlayer.runtime.copying._followers import NotCopyable

__all__ = ["Copies", "NotCopyable"]

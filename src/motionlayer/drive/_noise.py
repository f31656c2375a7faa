"""Noise without a state: a number that depends on the key of a stream and the tick, and on nothing else.

Integers stay below 2**63 in every step, so that Python, NumPy and compiled code agree to the bit: words of 32 bits,
multiplied by constants below 2**31.
"""

import hashlib
from typing import Final

from motionlayer._kernel import kernel

WORD: Final = 0xFFFFFFFF
SECOND: Final = 0x3C6EF372
SCALE: Final = 1.7320508075688772 / 65536.0  # sqrt(3): a sum of four uniform numbers has the variance 4/12
MEAN: Final = 2.0 * 65535.0


def key_of(seed: int, name: str) -> tuple[int, int]:
    """Return the key of a stream, two words, from the seed of the run and the name of what is noisy."""
    digest = hashlib.blake2b(f"{seed} drive {name}".encode(), digest_size=8).digest()
    return int.from_bytes(digest[:4], "little"), int.from_bytes(digest[4:], "little")


@kernel
def mix(word: int) -> int:
    """Scatter the bits of a word of 32 bits over all of it; one to one."""
    word = word ^ (word >> 16)
    word = (word * 0x21F0AAAD) & WORD
    word = word ^ (word >> 15)
    word = (word * 0x735A2D97) & WORD
    return word ^ (word >> 15)


@kernel
def noise(key: int, other: int, tick: int) -> float:
    """Return a nearly normal number of mean 0 and deviation 1, never beyond 3.5: a sum of four uniform ones."""
    seed = mix((tick & WORD) ^ key)
    first = mix(seed ^ other ^ ((tick >> 32) & WORD))
    second = mix((first + SECOND) & WORD)
    parts = (first & 0xFFFF) + (first >> 16) + (second & 0xFFFF) + (second >> 16)
    return (parts - MEAN) * SCALE

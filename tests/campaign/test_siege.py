"""The campaign against a real ADS server notices what it is there to notice."""

import pytest

from motionlayer.bench.campaign._ads_siege import BATCH, KINDS, besiege, cries
from tests.connect.planted import command

SEED = 1


def test_all_kinds_of_clients_come() -> None:
    assert {kind for case in range(20) for kind, _ in cries(SEED, case)} == set(KINDS)


@pytest.mark.slow
def test_a_server_stands_a_batch() -> None:
    assert besiege(SEED, range(BATCH)) == []


@pytest.mark.slow
@pytest.mark.parametrize(
    ("fault", "found"),
    [
        ("hang", "the other client is not answered within 5 s"),
        ("crash", "the server has ended with 3"),
        ("fail", "RuntimeError: planted"),
        ("leak", "the memory has grown by"),
    ],
)
def test_a_fault_that_is_planted_in_the_server_is_found(fault: str, found: str) -> None:
    (failure,) = besiege(SEED, range(BATCH, 2 * BATCH), command(fault))
    assert found in failure.text
    assert BATCH <= failure.case < 2 * BATCH

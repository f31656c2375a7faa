import gc

import pytest

from tests import effort

effort.register()


def pytest_collection_finish() -> None:
    """Take the tests themselves out of the garbage collector's reach: it takes a sixth of the time to look there."""
    gc.collect()
    gc.freeze()


@pytest.hookimpl(trylast=True)
def pytest_runtest_teardown() -> None:
    """Do it anew after a run in real time, which gives back to the collector whatever was out of its reach."""
    if not gc.get_freeze_count():
        gc.freeze()

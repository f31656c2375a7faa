import gc

from tests import effort

effort.register()

# The tests themselves are a million objects: to look through all of them as often as usual takes a tenth of the time.
_YOUNG, _MIDDLE, _OLD = gc.get_threshold()
gc.set_threshold(_YOUNG, _MIDDLE, 5 * _OLD)

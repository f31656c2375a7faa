"""A trace as one page to look at: key figures, the path in the plane, linked plots over time.

The page is one HTML file that needs nothing from outside. The plots open on a few moves after homing; a strip
shows the whole run and chooses another stretch. A curve keeps only as many rows as draw it within a small share
of its range, the same at every zoom; no peak is lost by more than that, and the file stays small.
"""

from motionlayer.record.plot._page import write_page

__all__ = ["write_page"]

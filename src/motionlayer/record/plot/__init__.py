"""A trace as one page to look at: key figures, the path in the plane, linked plots over time.

The page is one HTML file that needs nothing from outside; the same trace gives the same bytes. The plots show all
of a short run and open on a few moves after homing of a longer one; a strip shows the whole run and chooses another
stretch. What failed, was refused or was cut short is marked where it happened. A curve keeps only as many rows as
draw it within a small share of its range, the same at every zoom; no peak is lost by more than that, and the file
stays small.
"""

from motionlayer.record.plot._page import write_page

__all__ = ["write_page"]

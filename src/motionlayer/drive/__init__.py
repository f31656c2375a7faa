"""Drives, without I/O: simulated ones, and the profiles of real ones."""

from motionlayer.drive._ideal import IdealDrives, ReferenceSwitch

__all__ = ["IdealDrives", "ReferenceSwitch"]

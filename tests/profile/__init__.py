# ruff: noqa: A005 - tests.profile, never top level

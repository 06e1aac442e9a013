"""Tests of pytest that compare the descriptions of robots.

A test module needs two lines, and pytest needs no setup, as the package registers its plugin:

    from congruent.pytest import congruent_check

    test_robots = congruent_check("robots/*")
"""

from ._request import CheckRequest, congruent_check

__all__ = ["CheckRequest", "congruent_check"]

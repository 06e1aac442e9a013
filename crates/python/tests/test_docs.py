"""The examples of the guide are run, and print what is shown."""

import doctest
from pathlib import Path

import pytest

import congruent

FLAGS = doctest.ELLIPSIS | doctest.NORMALIZE_WHITESPACE


def test_the_page(root: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(root)
    failed, tried = doctest.testfile(str(root / "docs/python.md"), module_relative=False, optionflags=FLAGS)
    assert failed == 0 and tried > 25


def test_the_package(root: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(root)
    failed, tried = doctest.testmod(congruent, optionflags=FLAGS)
    assert failed == 0 and tried >= 3

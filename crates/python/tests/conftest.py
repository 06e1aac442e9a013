"""The robots of the repository, for all tests."""

import os
from pathlib import Path

import pytest

import congruent

ROOT = Path(__file__).resolve().parents[3]
ROBOTS = ROOT / "robots"

# A folder with public robots that nobody in the project wrote, which tests use if there is one.
_corpus = os.environ.get("CONGRUENT_CORPUS")
CORPUS = Path(_corpus) if _corpus else None


@pytest.fixture
def root() -> Path:
    """The root of the repository."""
    return ROOT


@pytest.fixture(scope="session")
def ur5e() -> congruent.Robot:
    return congruent.Robot(ROBOTS / "ur5e")


@pytest.fixture(scope="session")
def panda() -> congruent.Robot:
    """Seven joints, and two fingers of which one follows the other."""
    return congruent.Robot(ROBOTS / "panda")


def load(name: str) -> congruent.Robot:
    """A robot of the repository."""
    return congruent.Robot(ROBOTS / name)

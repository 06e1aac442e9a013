"""Edits of a robot file that keep every other byte: its comments, its order and its line ends."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass

# What may have a bracket or a line end in it, then the brackets and line ends themselves.
_TOKEN = re.compile(
    r'"""(?:[^\\]|\\.)*?"{3,5}'
    r"|'''.*?'{3,5}"
    r'|"(?:[^"\\\n]|\\.)*"'
    r"|'[^'\n]*'"
    r"|#[^\n]*"
    r"|[\[\]{}\n]",
    re.DOTALL,
)
_HEADER = re.compile(r"[ \t]*(\[\[?)([^\n]*?)\]\]?[ \t\r]*(?:#[^\n]*)?(?:\n|$)")
_KEY = re.compile(r'"([^"\n]*)"|\'([^\'\n]*)\'|([A-Za-z0-9_-]+)')


@dataclass(frozen=True)
class Section:
    """A header with the lines below it, up to its last value: comments in front of the next header belong to that."""

    path: tuple[str, ...]
    is_array: bool
    start: int
    end: int


def sections(text: str) -> list[Section]:
    """The sections of a document, in their order."""
    headers: list[tuple[tuple[str, ...], bool, int, int]] = []
    depth = 0
    line = 0
    at = 0
    while token := _TOKEN.search(text, at):
        at = token.end()
        match token.group()[0]:
            case "\n":
                line = at
            case "[" if depth == 0 and not text[line : token.start()].strip(" \t\ufeff"):
                header = _HEADER.match(text, token.start())
                if header is None:
                    return []
                path = tuple(next(filter(None, key), "") for key in _KEY.findall(header[2]))
                headers.append((path, header[1] == "[[", line, header.end()))
                line = at = header.end()
            case "[" | "{":
                depth += 1
            case "]" | "}":
                depth -= 1
    # Without a header there is no end that counts.
    ends = [start for _, _, start, _ in headers[1:]] + [len(text)]
    return [
        Section(path, is_array, start, body + _length_of_values(text[body:end]))
        for (path, is_array, start, body), end in zip(headers, ends, strict=False)
    ]


def _length_of_values(body: str) -> int:
    """The length of a body without the blank lines and the comments at its end."""
    lines = body.splitlines(keepends=True)
    while lines and (not lines[-1].strip() or lines[-1].lstrip().startswith("#")):
        lines.pop()
    return sum(map(len, lines))


@dataclass(frozen=True)
class MappingPlace:
    """Where a mapping is declared."""

    reference: int | None = None
    """The place under ``[[reference]]``, from 0; ``None`` for ``[mapping]``."""

    @property
    def name(self) -> str:
        """How the robot file calls it."""
        return "[mapping]" if self.reference is None else "[reference.mapping]"

    def find(self, text: str) -> list[Section]:
        """Its sections, of which ``[mapping.joints]`` is one."""
        if self.reference is None:
            return [section for section in sections(text) if section.path[:1] == ("mapping",)]
        return [section for section in self._sections_of_reference(text) if section.path[1:2] == ("mapping",)]

    def _sections_of_reference(self, text: str) -> list[Section]:
        """The sections of this ``[[reference]]``."""
        found: list[Section] = []
        count = 0
        for section in sections(text):
            if section.path[:1] != ("reference",):
                continue
            count += section.path == ("reference",) and section.is_array
            if count - 1 == self.reference:
                found.append(section)
        return found

    def removed(self, text: str) -> str:
        """The text without it."""
        return _without(text, self.find(text))

    def written(self, text: str, lines: list[str]) -> str | None:
        """The text with these lines in its place, or at the end of what it belongs to; ``None`` if there is no such place, as for
        a reference in one line."""
        newline = "\r\n" if "\r\n" in text else "\n"
        if self.reference is not None:
            lines = [line.replace("[mapping", "[reference.mapping", 1) if line.startswith("[") else line for line in lines]
        block = "".join(line + newline for line in lines)
        if declared := self.find(text):
            first, *others = declared
            text = _without(text, others)
            return text[: first.start] + block + text[first.end :]
        if self.reference is None:
            line_end = "" if text.endswith("\n") else newline
            return text + line_end + newline + block
        owner = self._sections_of_reference(text)
        if not owner:
            return None
        end = owner[-1].end
        line_end = "" if text[:end].endswith("\n") else newline
        return text[:end] + line_end + block + text[end:]


def _without(text: str, cut: list[Section]) -> str:
    """The text without these sections."""
    for section in reversed(cut):
        text = text[: section.start] + text[section.end :]
    return text


def with_values(text: str, table: str, values: Mapping[str, str]) -> str | None:
    """The text with these values of keys of a table in the place of others; ``None`` if the table does not write one of them in a
    line of its own."""
    for key, value in values.items():
        written = None
        for section in sections(text):
            if section.path != (table,):
                continue
            line = re.compile(rf"^[ \t]*[\"']?{re.escape(key)}[\"']?[ \t]*=[ \t]*([^\s#]+)", re.MULTILINE)
            written = line.search(text, section.start, section.end)
        if written is None:
            return None
        text = text[: written.start(1)] + value + text[written.end(1) :]
    return text

"""Values of Python as TOML, as far as studies have them."""

from __future__ import annotations

import math
import os
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np


def document(study: Mapping[str, Any]) -> str:
    """A study: a section for each mapping, one of several for each mapping of a list."""
    values, sections = [], []
    for key, value in study.items():
        if isinstance(value, Mapping):
            sections.append((f"[{text(key)}]", value))
        elif _is_list(value) and len(value) and all(isinstance(item, Mapping) for item in value):
            sections += [(f"[[{text(key)}]]", item) for item in value]
        else:
            values.append(f"{text(key)} = {inline(value)}")
    for title, section in sections:
        values += ["", title, *(f"{text(key)} = {inline(value)}" for key, value in section.items())]
    return "\n".join(values) + "\n"


def overrides(changes: Mapping[str, Any], above: str = "") -> Iterator[str]:
    """``key=value`` for each key that changes, dotted; a mapping changes what it names."""
    for key, value in changes.items():
        if isinstance(value, Mapping):
            yield from overrides(value, f"{above}{key}.")
        else:
            yield f"{above}{key}={inline(value)}"


def inline(value: Any) -> str:
    """A value in one line."""
    if isinstance(value, np.generic) or (isinstance(value, np.ndarray) and value.ndim == 0):
        value = value.item()
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, int):
        return str(value)
    if isinstance(value, float):
        return repr(value) if math.isfinite(value) else ("nan" if math.isnan(value) else f"{'-' * (value < 0)}inf")
    if isinstance(value, (str, os.PathLike)):
        return text(os.fspath(value))
    if isinstance(value, Mapping):
        return "{" + ", ".join(f"{text(key)} = {inline(item)}" for key, item in value.items()) + "}"
    if _is_list(value):
        return "[" + ", ".join(inline(item) for item in value) + "]"
    raise TypeError(f"a study holds numbers, texts, lists and mappings, and this is {type(value).__name__}: {value!r}")


def text(value: str) -> str:
    """A text in quotes."""
    if not isinstance(value, str):
        raise TypeError(f"a study holds text here, and this is {type(value).__name__}: {value!r}")
    plain = value.replace("\\", "\\\\").replace('"', '\\"')
    return '"' + "".join(f"\\u{ord(one):04x}" if ord(one) < 32 or ord(one) == 127 else one for one in plain) + '"'


def _is_list(value: Any) -> bool:
    return isinstance(value, (Sequence, np.ndarray)) and not isinstance(value, (str, bytes))

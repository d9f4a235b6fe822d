"""The shape of a bearing's bore, one record a kind.

A kind of bearing is a `Geometry`: a frozen record of what shapes its bore besides diameter, length
and clearance. Its word, `kind`, stands in files and links. `models` names the film models that
answer for it; the first is the one that a bearing uses unless it is told another.
"""

from dataclasses import dataclass
from typing import ClassVar

from rotorcalc.records import Kind


@dataclass(frozen=True, kw_only=True)
class Geometry(Kind):
    """The shape of a bore; every kind of bearing is a record below this one."""

    models: ClassVar[tuple[str, ...]] = ()


@dataclass(frozen=True, kw_only=True)
class Plain(Geometry):
    """A circular bore of 360° without a groove."""

    kind: ClassVar[str] = "plain"
    models: ClassVar[tuple[str, ...]] = ("short",)

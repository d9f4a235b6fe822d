"""The shape of a bearing's bore, one record class per kind.

A kind of bearing is a `Geometry`: a frozen record of the bore's shape apart from diameter, length
and clearance. Its word, `kind`, is used in files and links. `models` names the film models that
apply to it; the first is the default.
"""

from dataclasses import dataclass
from typing import ClassVar

from rotorcalc.records import Kind


@dataclass(frozen=True, kw_only=True)
class Geometry(Kind):
    """The shape of a bore; every kind of bearing is a subclass."""

    models: ClassVar[tuple[str, ...]] = ()


@dataclass(frozen=True, kw_only=True)
class Plain(Geometry):
    """A circular bore of 360° without a groove."""

    kind: ClassVar[str] = "plain"
    models: ClassVar[tuple[str, ...]] = ("short",)

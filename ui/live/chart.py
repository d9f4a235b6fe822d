"""A chart that keeps its place in the page, its zoom and its hidden lines while its data change."""

import base64
from typing import Any

import numpy as np
import orjson
from streamlit.components.v2 import component

from rotorcalc.figures import Chart
from ui.live import assets

# Arrays this short are sent faster as text than packed.
_FEW = 8
_component = component("rotorcalc.chart", js=assets.module("chart"), isolate_styles=False)


def show(
    chart: Chart, *, key: str, alt: str, config: dict[str, Any], presenting: bool = False
) -> None:
    """Show a chart; `alt` is its text alternative, `config` is Plotly's.

    Where it is presented its type is large, and it fills the window.
    """
    message = {
        "key": key, "chart": chart, "config": config, "alt": alt,
        "presenting": presenting,
        "plotly": assets.plotly_bundle(),
        "scripts": {name: assets.script(name) for name in ("move", "contour", "cursor", "drawing")},
    }  # fmt: skip
    _component(key=key, data=encoded(message))


def encoded(message: dict[str, Any]) -> bytes:
    """Return a message as JSON with its arrays as Plotly's script reads them, in single precision.

    Seven digits are more than a screen shows, at half the bytes of double precision.
    """
    return orjson.dumps(message, default=_array)


def _array(value: Any) -> Any:
    if isinstance(value, np.generic):
        return value.item()
    if not isinstance(value, np.ndarray):
        raise TypeError(f"{type(value).__name__} in a chart")
    if value.dtype.kind != "f" or value.size <= _FEW:
        return value.tolist()
    single = _single(value)
    spec = {"dtype": single.dtype.str[1:], "bdata": base64.b64encode(single.tobytes()).decode()}
    return spec if value.ndim == 1 else spec | {"shape": ",".join(map(str, value.shape))}


def _single(value: np.ndarray) -> np.ndarray:
    """Return an array in single precision, or in double where it does not fit."""
    if value.dtype == np.float32:
        return value
    with np.errstate(over="ignore"):
        single = value.astype(np.float32)
    # Single precision ends at 3e38; an infinity that was there before may stay one.
    if np.isinf(single).any() and np.any(np.isinf(single) & np.isfinite(value)):
        return value.astype(np.float64)
    return single

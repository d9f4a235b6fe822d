"""Health check, whether this server is well: python -m ui.serving.health [ADDRESS]

`check` solves the calculation sheet's machine and compares. `pulse.py` does that and looks at the
other parts, and the app answers at /healthz what is wrong; Streamlit's own /_stcore/health tells
only that a web server runs. Run as a program this asks such an address, and exits with an error and
the reason where the answer is not good or not there in five seconds.
"""

import json
import math
import os
import sys
from urllib.error import HTTPError, URLError
from urllib.request import urlopen

from rotorcalc import PRESETS, analyse, onset_speed

TIMEOUT = 5.0  # seconds
# The calculation sheet at 6000 rpm, and the onset of its flexible rotor.
_EXPECTED = {"sommerfeld": 3.91447, "eccentricity_ratio": 0.080116, "onset_rpm": 8919.3}
_TOLERANCE = 1e-4  # above the last printed digits


class WrongAnswerError(Exception):
    """The core's results differ from the calculation sheet's."""


def check() -> None:
    """Compute, and raise WrongAnswerError naming the quantity that is off."""
    machine = PRESETS["sheet-1e8"].machine
    point = analyse(machine, 6000 * math.pi / 30)
    found = {
        "sommerfeld": float(point.sommerfeld),
        "eccentricity_ratio": float(point.eccentricity_ratio),
        "onset_rpm": onset_speed(machine).speed * 30 / math.pi,
    }
    for name, expected in _EXPECTED.items():
        if not math.isclose(found[name], expected, rel_tol=_TOLERANCE):
            raise WrongAnswerError(f"{name} = {found[name]:.6g}: must be {expected:g}")


def main() -> None:
    """Query a server, by default the one of the environment's settings."""
    port = os.environ.get("STREAMLIT_SERVER_PORT", "8501")
    path = os.environ.get("STREAMLIT_SERVER_BASE_URL_PATH", "").strip("/")
    own = "/".join(filter(None, (f"http://127.0.0.1:{port}", path, "healthz")))
    address = sys.argv[1] if len(sys.argv) > 1 else own
    if not address.startswith(("http://", "https://")):
        sys.exit(f"{address}: no http address")
    try:
        with urlopen(address, timeout=TIMEOUT) as answer:  # noqa: S310 - http, as checked
            good = json.load(answer).get("status") == "good"
    except HTTPError as error:
        sys.exit(f"{address}: {error.code} {error.read(1000).decode(errors='replace')}")
    except (URLError, OSError, ValueError) as error:
        sys.exit(f"{address}: {error}")
    sys.exit(0 if good else f"{address}: not good")


if __name__ == "__main__":
    main()

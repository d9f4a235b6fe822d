"""All results, by their keys, in the order of the report."""

from ui.results.equilibrium import EQUILIBRIUM
from ui.results.heat import HEAT
from ui.results.record import Result
from ui.results.response import RESPONSE
from ui.results.ring import RING
from ui.results.stability import STABILITY

RESULTS: dict[str, Result] = {
    result.key: result for result in (*EQUILIBRIUM, *RING, *HEAT, *STABILITY, *RESPONSE)
}

"""How sure is it? The onset within the tolerances of clearance and temperature."""

import numpy as np

import rotorcalc as rc

machine = rc.PRESETS["sheet-1e8"].machine
spreads = {"radial_clearance": ("uniform", 50e-6, 80e-6), "temperature": ("normal", 60.0, 4.0)}
found = rc.tolerance(machine, spreads, samples=20_000, seed=1, speed=8500 * rc.rpm)

low, middle, high = np.quantile(found.onset, [0.05, 0.5, 0.95]) / rc.rpm
print(f"Onset, 5 %, 50 % and 95 % of the machines: {low:.0f}, {middle:.0f}, {high:.0f} rpm")

unstable = found.probability_unstable
print(
    f"Unstable at 8500 rpm: {100 * unstable.value:.1f} % of them, "
    f"between {100 * unstable.low:.1f} and {100 * unstable.high:.1f} % with 95 % confidence"
)
for one in found.influences:
    print(f"{one.field}: {100 * one.index:.1f} % of the onset's variance")

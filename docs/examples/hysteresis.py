"""Hysteresis: beyond the onset a machine whirls, and does not stop where it began."""

import rotorcalc as rc

machine = rc.varied(rc.PRESETS["sheet-1e8"].machine, {"imbalance": 0.0})
branch = rc.bifurcation(machine)
onset, fold = branch.hopf.speed, branch.folds.min()

print(f"A small disturbance grows from {onset / rc.rpm:.0f} rpm on")
print(f"A whirl lasts down to {fold / rc.rpm:.0f} rpm, {100 * (1 - fold / onset):.1f} % below")

between, clearance = 0.5 * (onset + fold), machine.bearing.radial_clearance
print(f"At {between / rc.rpm:.0f} rpm, between the two, after 200 revolutions:")
for kick in (0.02, 0.6):
    start = rc.start_on_mode(machine, between, amplitude=kick * clearance)
    motion = rc.simulate(machine, between, revolutions=200, start=start)
    last = motion.journal[-1000:]
    size = abs(last - last.mean(axis=0)).max() / clearance
    print(f"displaced by {kick:.2f} C at first, the journal moves by {size:.3f} C")

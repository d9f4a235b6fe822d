"""The calculation sheet of the notes: one rotor, from load and oil to the onset of whirl."""

import numpy as np

import rotorcalc as rc

machine = rc.PRESETS["sheet-1e8"].machine
print(f"Load on each bearing: {machine.static_load:.0f} N")

sweep = rc.analyse(machine, np.array([3000.0, 6000.0, 9000.0]) * rc.rpm)
print("rpm     ε      φ [°]   K_XY [MN/m]   C_XX [MN·s/m]   whirl ratio")
for i, speed in enumerate(sweep.speed / rc.rpm):
    print(
        f"{speed:5.0f}  {sweep.eccentricity_ratio[i]:.4f}"
        f"  {np.degrees(sweep.attitude_angle[i]):5.1f}"
        f"  {sweep.stiffness[i, 0, 1] / 1e6:11.1f}  {sweep.damping[i, 0, 0] / 1e6:13.3f}"
        f"  {sweep.whirl_ratio[i]:12.4f}"
    )

onset = rc.onset_speed(machine)
print(f"Onset of whirl: {onset.speed / rc.rpm:.0f} rpm")
print(f"It whirls at {onset.whirl_frequency / onset.speed:.3f} of that speed")

"""Your own coefficients: a table in its own units and axes, and what a rotor does on it."""

from dataclasses import replace

import rotorcalc as rc

# y points up, against the load; the shaft turns from x to y.
TABLE = """\
rpm;kxx [MN/m];kxy [MN/m];kyx [MN/m];kyy [MN/m];cxx [kN·s/m];cxy [kN·s/m];cyx [kN·s/m];cyy [kN·s/m]
2000;55,0;90,4;-120,5;34,3;926;-264;-264;1087
4000;56,1;182,0;-198,3;30,0;886;-134;-134;930
6000;56,4;273,3;-284,4;29,1;878;-90;-90;897
8000;56,5;364,5;-372,9;28,8;875;-67;-67;886
10000;56,6;455,7;-462,4;28,6;873;-54;-54;880
"""
read = rc.read_coefficients(TABLE, load_axis="-y", turns="x to y")
for column in read.columns:
    print(f"{column.header}: in {column.unit}, by {column.why}")
for words in (*read.notes, *read.warnings):
    print(words)

table = rc.CoefficientTable(speed=read.speed, stiffness=read.stiffness, damping=read.damping)
machine = replace(rc.PRESETS["sheet-1e8"].machine, bearing=table)
onset = rc.onset_speed(machine)
print(f"On these coefficients whirl begins at {onset.speed / rc.rpm:.0f} rpm")

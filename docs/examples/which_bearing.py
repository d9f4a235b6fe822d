"""Which bearing? Every kind on the same journal, with the same oil and load."""

import rotorcalc as rc

machine = rc.PRESETS["sheet-1e8"].machine
bores = (rc.Plain(), rc.Elliptical(), rc.Lobes(), rc.PressureDam(), rc.TiltingPads())
found = rc.compare_bearings(machine, bores, speed=6000 * rc.rpm)

print("bearing          onset [rpm]   log decrement   power [kW]   smallest film [µm]")
for one in sorted(found, key=lambda one: one.onset):
    print(
        f"{one.bearing.geometry.kind:15s}  {one.onset / rc.rpm:11.0f}  {one.log_decrement:14.3f}"
        f"  {one.power_loss / 1e3:11.2f}  {one.minimum_film_thickness * 1e6:17.1f}"
    )

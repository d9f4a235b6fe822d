"""The equations that the results of a hydrostatic film are cited by."""

from rotorcalc.films.model import Source

# As short as a number of an equation: they label the buttons that explain a result.
_SOLVED = "Reynolds' equation"
_BALANCE = "balance of flow and force"
_LINEAR = "linearised balance"
SOURCES: dict[str, Source] = {
    "film": Source(
        f"{_SOLVED} of the full film on the lands, one pressure in each recess; restrictors as in "
        "Rowe, Hydrostatic, Aerostatic and Hybrid Bearing Design (2012)",
        r"\frac{\partial}{\partial\beta}\left(h^3\frac{\partial p}{\partial\beta}\right)"
        r"+\left(\frac DL\right)^2\frac{\partial}{\partial\zeta}"
        r"\left(h^3\frac{\partial p}{\partial\zeta}\right)"
        r"=6\mu\Omega\left(\frac RC\right)^2\frac{\partial h}{\partial\beta},\quad p=p_k",
    ),
    "eccentricity": Source(_BALANCE, r"F_X(x,y,p_k)=-F_o,\quad F_Y=0,\quad Q_k(p_k)=q_k(x,y,p)"),
    "attitude": Source(_BALANCE, r"\tan\varphi=\frac yx"),
    "thickness": Source("circular bore", r"\frac hC=1-x\cos\beta-y\sin\beta"),
    "pressure": Source(_SOLVED, remark="uniform in each recess, ambient at both ends"),
    "force": Source(_SOLVED),
    "drag": Source(
        "shear of the lands",
        r"T=\frac{\mu\Omega R^3L}{2C}\iint_{lands}\frac{d\beta\,d\zeta}{h}+\tfrac12eF_o\sin\varphi",
        remark="without that of the recesses, which are much deeper than the film",
    ),
    "flow": Source(
        "flow through the restrictors",
        r"Q=\sum q_0\frac{p_s-p_k}{p_s}\ \text{(capillary)},\quad"
        r"\sum q_0\sqrt{\frac{p_s-p_k}{p_s}}\ \text{(orifice)}",
    ),
    "stiffness": Source(_LINEAR, remark="the recess pressures change with the journal's position"),
    "damping": Source(_LINEAR, remark="the recess pressures change with the journal's velocity"),
    "k": Source(_LINEAR),
    "c": Source(_LINEAR),
    "XY": Source(_LINEAR),
    "rt": Source(_LINEAR),
    "centre": Source(_LINEAR, r"K_{XY}=-K_{YX}=\tfrac{\Omega}{2}C_{XX}"),
    "half speed": Source(_LINEAR, r"\frac{\omega_s}{\Omega_s}\to\tfrac12"),
}

"""Where the results of a foil bearing's film come from, for captions."""

from rotorcalc.films.model import Source

# As short as a number of an equation: they label the buttons that explain a result.
_SOLVED = "Reynolds' equation of a gas"
_BALANCE = "force balance"
_LINEAR = "linearised Reynolds' equation"
SOURCES: dict[str, Source] = {
    "film": Source(
        f"{_SOLVED} on an elastic foundation that is pressed but not pulled (Heshmat, Walowit & "
        "Pinkus 1983)",
        r"\frac{\partial}{\partial\beta}\left(ph^3\frac{\partial p}{\partial\beta}\right)"
        r"+\left(\frac DL\right)^2\frac{\partial}{\partial\zeta}"
        r"\left(ph^3\frac{\partial p}{\partial\zeta}\right)"
        r"=\Lambda\frac{\partial(ph)}{\partial\beta},\quad\Lambda=\frac{6\mu\Omega}{p_a}"
        r"\left(\frac RC\right)^2",
    ),
    "eccentricity": Source(_BALANCE, r"F_X(x,y)=-F_o,\quad F_Y(x,y)=0"),
    "attitude": Source(_BALANCE, r"\tan\varphi=\frac yx"),
    "thickness": Source(
        "gap and deflection",
        r"\frac hC=1-x\cos\beta-y\sin\beta+\alpha\max(p-1,0),\quad\alpha=\frac{p_a}{Ck_f}",
    ),
    "pressure": Source(_SOLVED, remark="ambient at the slit and at both ends"),
    "force": Source(_SOLVED, remark="of the pressure above ambient"),
    "drag": Source(
        "shear of the film",
        r"T=\frac{\mu\Omega R^3L}{C}\int_0^1\!\!\int\left(\frac1h+\frac{3h}{\Lambda}\,"
        r"\frac{\partial p}{\partial\beta}\right)d\beta\,d\zeta",
    ),
    "flow": Source(
        "axial flow",
        r"Q=\frac{\Omega RLC}{2\Lambda}\left(\frac DL\right)^2\int"
        r"-ph^3\left.\frac{\partial p}{\partial\zeta}\right|_{\zeta=1}d\beta",
        "a volume at ambient density, which the slit takes in",
    ),
    "stiffness": Source(_LINEAR),
    "damping": Source(_LINEAR),
    "k": Source(_LINEAR),
    "c": Source(_LINEAR),
    "XY": Source(_LINEAR),
    "rt": Source(_LINEAR),
}

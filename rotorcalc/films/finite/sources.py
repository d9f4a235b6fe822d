"""What the results of a film of finite length come from, for captions."""

from rotorcalc.films.model import Source

# As short as a number of an equation: they label the buttons that explain a result.
_SOLVED = "Reynolds' equation"
_NEWTON = "force balance"
_LINEAR = "linearised Reynolds' equation"
SOURCES: dict[str, Source] = {
    "film": Source(
        f"{_SOLVED} with Swift and Stieber's p = ∂p/∂n = 0 where the film breaks and forms",
        r"\frac{\partial}{\partial\beta}\left(h^3\frac{\partial p}{\partial\beta}\right)"
        r"+\left(\frac DL\right)^2\frac{\partial}{\partial\zeta}"
        r"\left(h^3\frac{\partial p}{\partial\zeta}\right)"
        r"=6\frac{\partial h}{\partial\beta},\quad p\ge0",
    ),
    "eccentricity": Source(_NEWTON, r"F_X(x,y)=-F_o,\quad F_Y(x,y)=0"),
    "attitude": Source(_NEWTON, r"\tan\varphi=\frac yx"),
    "thickness": Source(
        "arcs of the pads",
        r"\frac hC=1+a_x\cos\beta+a_y\sin\beta-x\cos\beta-y\sin\beta",
    ),
    "pressure": Source(_SOLVED, remark="ambient at the pads' edges and both ends"),
    "force": Source(_SOLVED),
    "drag": Source(
        "shear of the pads",
        r"T=\frac{\mu\Omega R^3L}{C}\sum\int\left(\frac1h+\frac h2\,"
        r"\frac{\partial\bar p}{\partial\beta}\right)d\beta",
    ),
    "flow": Source(
        "axial flow",
        r"Q=\frac{\Omega RLC}{12}\left(\frac DL\right)^2\sum\int"
        r"-h^3\left.\frac{\partial p}{\partial\zeta}\right|_{\zeta=1}d\beta",
    ),
    "stiffness": Source(_LINEAR),
    "damping": Source(_LINEAR),
    "k": Source(_LINEAR),
    "c": Source(_LINEAR),
    "XY": Source(_LINEAR),
    "rt": Source(_LINEAR),
}

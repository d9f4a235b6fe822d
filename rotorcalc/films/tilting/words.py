"""What a tilting-pad film cites."""

from rotorcalc.films.model import Source

# As short as a number of an equation: they label the buttons that explain a result.
_SOLVED = "Reynolds' equation"
_PADS = "balance of journal and pads"
_LINEAR = "linearised Reynolds' equation, tilts eliminated"
_REDUCED = (
    r"\mathbf Z=\sum_{\mathrm{pads}}\mathbf T^{\mathsf T}\left(\mathbf Z_p"
    r"-\frac{\mathbf Z_{p,\cdot\eta}\,\mathbf Z_{p,\eta\cdot}}"
    r"{Z_{\eta\eta}+\kappa-\nu^2I}\right)\mathbf T"
)
SOURCES: dict[str, Source] = {
    "film": Source(
        f"{_SOLVED} with Swift and Stieber's p = ∂p/∂n = 0 where the film breaks and forms",
        r"\frac{\partial}{\partial\beta}\left(h^3\frac{\partial p}{\partial\beta}\right)"
        r"+\left(\frac DL\right)^2\frac{\partial}{\partial\zeta}"
        r"\left(h^3\frac{\partial p}{\partial\zeta}\right)"
        r"=6\frac{\partial h}{\partial\beta},\quad p\ge0",
    ),
    "eccentricity": Source(
        _PADS, r"\sum f(m+x\cos\beta_p)\cos\beta_p=F_o,\quad F_\eta(\xi,\eta)=\kappa\delta"
    ),
    "attitude": Source(_PADS, r"\tan\varphi=\frac yx"),
    "thickness": Source(
        "tilted pads",
        r"\frac hC=1-\xi\cos(\beta-\beta_p)-\eta\sin(\beta-\beta_p)",
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
    "stiffness": Source(_LINEAR, _REDUCED, remark="in synchronous motion, ν = 1"),
    "damping": Source(_LINEAR, _REDUCED, remark="in synchronous motion, ν = 1"),
    "k": Source(_LINEAR, _REDUCED),
    "c": Source(_LINEAR, _REDUCED),
    "XY": Source(_LINEAR, _REDUCED),
    "rt": Source(_LINEAR, _REDUCED),
}

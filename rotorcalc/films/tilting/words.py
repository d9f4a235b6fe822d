"""What a tilting-pad film cites."""

from rotorcalc.films.finite import sources as finite
from rotorcalc.films.model import Source

# As short as a number of an equation: they label the buttons that explain a result.
_PADS = "balance of journal and pads"
_LINEAR = "linearised Reynolds' equation, tilts eliminated"
_REDUCED = (
    r"\mathbf Z=\sum_{\mathrm{pads}}\mathbf T^{\mathsf T}\left(\mathbf Z_p"
    r"-\frac{\mathbf Z_{p,\cdot\eta}\,\mathbf Z_{p,\eta\cdot}}"
    r"{Z_{\eta\eta}+\kappa-\nu^2I}\right)\mathbf T"
)
SOURCES: dict[str, Source] = {
    # The films of its pads are those of any bore of finite length.
    **{name: finite.SOURCES[name] for name in ("film", "pressure", "force", "drag", "flow")},
    "eccentricity": Source(
        _PADS, r"\sum f(m+x\cos\beta_p)\cos\beta_p=F_o,\quad F_\eta(\xi,\eta)=\kappa\delta"
    ),
    "attitude": Source(_PADS, r"\tan\varphi=\frac yx"),
    "thickness": Source(
        "tilted pads",
        r"\frac hC=1-\xi\cos(\beta-\beta_p)-\eta\sin(\beta-\beta_p)",
    ),
    "stiffness": Source(_LINEAR, _REDUCED, remark="in synchronous motion, ν = 1"),
    "damping": Source(_LINEAR, _REDUCED, remark="in synchronous motion, ν = 1"),
    "k": Source(_LINEAR, _REDUCED),
    "c": Source(_LINEAR, _REDUCED),
    "XY": Source(_LINEAR, _REDUCED),
    "rt": Source(_LINEAR, _REDUCED),
}

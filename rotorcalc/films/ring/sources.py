"""What a floating ring's results come from, for captions."""

from rotorcalc.films.model import Source

_TWO = "two plain films in series"
_TORQUES = "torques on the ring"
_LINEAR = "both films, the ring eliminated at running speed"
SOURCES: dict[str, Source] = {
    "film": Source(
        f"{_TWO}, with a ring between them that turns freely",
        r"\tfrac{2\pi}{s_i}(1-r)-\tfrac12y_i\bar F="
        r"\tfrac{2\pi}{s_o}\,m\,r+\tfrac12\tfrac{C_o}{C}y_o\bar F,\quad r=\frac{\Omega_R}{\Omega}",
    ),
    "eccentricity": Source(
        _TWO,
        r"\sigma_i=(1+r)\,\sigma,\quad\sigma_o=q\,r\,\sigma,\quad x=x_i+\frac{C_o}{C}x_o",
        remark="the journal moves in both films, so ε may exceed 1",
    ),
    "attitude": Source(_TWO, r"\tan\varphi=\frac yx"),
    "thickness": Source(
        "the thinner film", r"h_{min}=\min\left[C(1-\varepsilon_i),\ C_o(1-\varepsilon_o)\right]"
    ),
    "pressure": Source("pressure of the inner film", remark="the inner film's"),
    "force": Source(_TWO, remark="both films carry the same load"),
    "drag": Source(
        _TORQUES,
        r"T=\frac{2\pi\mu(\Omega-\Omega_R)R^3L}{C\,s_i}+\tfrac12e_iF_o\sin\varphi_i",
        remark="torque times speed is the loss of both films",
    ),
    "flow": Source("both films together", r"Q=Q_i+Q_o"),
    "stiffness": Source(_LINEAR),
    "damping": Source(_LINEAR),
    "k": Source(_LINEAR),
    "c": Source(_LINEAR),
    "XY": Source(_LINEAR),
    "rt": Source(_LINEAR),
}

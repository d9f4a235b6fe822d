"""Machines within tolerances: what their onset is, how likely they whirl, and what matters most."""

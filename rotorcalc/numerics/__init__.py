"""Numerical methods without any rotor dynamics: roots, and stability of polynomials."""

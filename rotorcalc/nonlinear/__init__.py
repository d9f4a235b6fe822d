"""Motions and limit cycles on the film's full force."""

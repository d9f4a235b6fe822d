"""Exercises on the notes: each with numbers of its own for every student, checked and explained."""

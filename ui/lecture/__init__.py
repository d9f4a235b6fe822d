"""The lecture: the notes as a sequence of steps, each with one view and one question.

The steps are data, in steps.toml; a lecturer may bring a file of the same form.
"""

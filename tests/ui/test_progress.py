"""The bar of a computation."""

from streamlit.testing.v1 import AppTest


def _half_done() -> None:
    from ui.jobs.bar import show_progress

    _, tell = show_progress("Computing …")
    tell(0.5)


def test_a_bar_keeps_its_words_while_it_moves() -> None:
    bar = AppTest.from_function(_half_done).run().get("progress")[0].proto
    assert (bar.value, bar.text) == (50, "Computing …")

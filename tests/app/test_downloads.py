"""A file that is made when asked for is there until its browser has fetched it."""

from collections.abc import Callable
from pathlib import PurePosixPath
from types import SimpleNamespace

import pytest
import streamlit as st
from streamlit import runtime
from streamlit.runtime.media_file_manager import MediaFileManager
from streamlit.runtime.memory_media_file_storage import MemoryMediaFileStorage

from ui.serving.downloads import KEPT, offer


@pytest.fixture
def manager(monkeypatch: pytest.MonkeyPatch) -> MediaFileManager:
    keeps = MediaFileManager(MemoryMediaFileStorage("/media"))
    monkeypatch.setattr(runtime, "get_instance", lambda: SimpleNamespace(media_file_mgr=keeps))
    return keeps


@pytest.fixture
def ask(monkeypatch: pytest.MonkeyPatch, manager: MediaFileManager) -> Callable[[str], str]:
    """Return how a browser asks for a file of a text, and is told its name at the server."""
    offered = []
    monkeypatch.setattr(st, "download_button", lambda _, data, *__, **___: offered.append(data))

    def asked(text: str) -> str:
        offer("Save", lambda: text, "a.txt", "text/plain")
        made = manager.add_deferred(offered.pop(), "text/plain", "button", "a.txt")
        return PurePosixPath(manager.execute_deferred(made)).stem

    return asked


def test_runs_of_others_take_no_file_away(manager: MediaFileManager, ask) -> None:
    name = ask("made")
    for _ in range(5):
        manager.remove_orphaned_files()  # as after every run
    kept = manager.read_file(name)
    assert kept is not None
    assert kept.content == b"made"


def test_a_server_keeps_the_last_files_only(manager: MediaFileManager, ask) -> None:
    names = [ask(f"file {at}") for at in range(KEPT + 3)]
    for _ in range(5):
        manager.remove_orphaned_files()
    assert [manager.read_file(name) is None for name in names] == [True] * 3 + [False] * KEPT

"""The server's visit to its own pages: whether a visitor who comes now gets one.

It is a session of Streamlit's runtime without a browser, closed when the page is drawn. What guards
and bounds visitors' requests stands before the runtime, and has nothing to do with it.
"""

import asyncio

from streamlit.proto.BackMsg_pb2 import BackMsg
from streamlit.proto.ForwardMsg_pb2 import ForwardMsg
from streamlit.runtime import Runtime
from streamlit.runtime.session_manager import SessionClient

from ui.serving import log

_SUCCESS = ForwardMsg.FINISHED_SUCCESSFULLY


class _Tab(SessionClient):
    """Takes what a browser would be sent, and keeps what went wrong."""

    def __init__(self) -> None:
        self.ended = asyncio.Event()
        self.fault = ""

    def write_forward_msg(self, msg: ForwardMsg) -> None:
        """Look at a message."""
        kind = msg.WhichOneof("type")
        if kind == "delta" and msg.delta.new_element.HasField("alert"):
            alert = msg.delta.new_element.alert
            if alert.title == log.TITLE:  # the first words name its id in the log
                self.fault = alert.body.partition(",")[0]
        elif kind == "delta" and msg.delta.new_element.HasField("exception"):
            self.fault = msg.delta.new_element.exception.type
        elif kind == "script_finished":
            if msg.script_finished != _SUCCESS:
                self.fault = ForwardMsg.ScriptFinishedStatus.Name(msg.script_finished)
            self.ended.set()


async def fault_of(page: str = "") -> str:
    """Draw a page by its name in the address, the first by none; return what went wrong, or ""."""
    runtime, tab = Runtime.instance(), _Tab()
    session = runtime.connect_session(tab, {})
    try:
        message = BackMsg()
        message.rerun_script.page_name = page
        runtime.handle_backmsg(session, message)
        await tab.ended.wait()
    finally:
        runtime.close_session(session)
    return tab.fault

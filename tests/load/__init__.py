"""Load on a server of the app, made of visitors that speak Streamlit's own websocket protocol."""

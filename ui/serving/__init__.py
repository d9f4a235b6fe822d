"""The server around the pages: health, log, settings, version."""

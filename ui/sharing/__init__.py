"""What leaves the app and comes back: links, files, tables, the report."""

"""What pages say and ask, a module a page."""

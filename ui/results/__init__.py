"""The numbers that pages and the report show: a row each, by topic."""

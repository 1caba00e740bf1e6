"""Comparing runs: which belong together, what their seeds say, by what their configs differ. No HTTP, no drawing."""

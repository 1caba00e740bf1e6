"""Runs for other trackers, each through its own library, which is an optional extra."""

"""A run as a Rerun file: curves, a few episodes in 3D and the log, laid out; made again from the store at any time."""

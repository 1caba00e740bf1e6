"""Thumbnails and videos of runs, drawn off screen by a process of their own, one after the other."""

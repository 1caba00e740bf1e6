"""What several seeds say together: pure functions on arrays, without files, store or network.

Letters: `N` seeds, `G` places of a grid, `M` tasks. The seed is always what is resampled, within its task.
"""

"""Comparisons on paper: figures, tables, and the bundle of both. Matplotlib is loaded only where something is drawn."""

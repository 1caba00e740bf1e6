# What is used of fsspec, which ships no types.

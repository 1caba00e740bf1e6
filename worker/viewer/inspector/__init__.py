"""The demonstration inspector: what a locomotion model makes its object do, looked at from all sides."""

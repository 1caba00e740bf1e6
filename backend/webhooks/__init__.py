"""Telling other services what has ended: which addresses may be told, what is sent, and sending it."""

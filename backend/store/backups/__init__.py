"""Backups: a data directory in itself, made while everything runs, and restored into a store of either engine."""

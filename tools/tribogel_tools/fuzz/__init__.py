"""Starts on generated inputs: sensible scenes (`scenes`), ways to spoil them (`spoilers`), meshes and runs in
files."""

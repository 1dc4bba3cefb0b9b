"""The package on the disk: a folder goes in; its state, its records and its models come out.

Manifest, markers and digests say what was generated; `models` reads what model and code say today.
"""

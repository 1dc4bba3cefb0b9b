"""Results, runs and state spaces as people and other programs read them.

The values come from `rebsync.checker.result`, `trace` and `show.space`; every module here turns
them into one kind of text: for terminals, JSON, message sequence charts, pages, drawings.
"""

"""What is known of sheets that were built before: one of which nothing has changed is not derived again.

`files` says what a sheet was read from, `program` what reads it, `stamps` what came of it. Begin with the
last. Nothing here imports what derives, so that an unchanged sheet costs next to nothing.
"""

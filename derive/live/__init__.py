"""`derive watch --serve`: a page in the browser that follows a sheet while it is written.

Begin with `following`: each save is built and shown. `view` is what a browser is told, `serving` how it asks.
"""

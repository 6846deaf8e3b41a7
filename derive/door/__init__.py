"""The Python door: sheets and questions without the command line, answers as SymPy and NumPy objects.

`import derive` imports nothing of this; `derive.load`, `derive.loads`, `derive.DeriveError` and a function
for each subject (`derive.robot`, `derive.motion`, ...) come from here when they are asked for.
"""

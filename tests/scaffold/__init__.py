"""A new kind of question: `python3 -m tests.scaffold SUBJECT KIND`, once to begin it and once to end it.

The first time it writes the module, the words and the sheet of a kind, which build as they stand;
`kind.py.txt` and `words.j2.txt` are what they are made of. Once nothing in them is left to be filled in, it
writes down what follows from them: the table of kinds in README.md and the pages of the sheet in output/.
"""

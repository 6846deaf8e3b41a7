"""One module for each kind of question, in the folder of its subject.

Begin with `work` (the board on which an answer is written) and `problem` (one subject and what was derived
about it). `api` is what the author of a kind imports, `checks` what proves an answer, `registry` how kinds
are found.
"""

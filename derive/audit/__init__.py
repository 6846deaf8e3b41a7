"""The audit: every answer derived a second time by SymPy, from the sheet's subject alone.

An auditor reads the frozen records of a subject and nothing else of the house: no normal form, no kind, no
formula of mechanics or control (an import contract in pyproject.toml says so). It says what each result
should be at an exact random point by the textbook's definition, and the engine puts the text that leaves the
house, the strings of the JSON, to the test there.

- `engine` says what is audited and what came of it;
- `text` reads a result (JSON text) and `trees` a record (typed tree) as SymPy expressions;
- `points` draws exact random points and evaluates SymPy expressions at them;
- `algebra` is what of SymPy may be dear, `linear` algebra of numbers, `budget` counts what an answer costs;
- `putting_back`, `conditions` and `roots` are for answers that are put back: two sides that must be one at a
  point, the words beside a branch, and roots looked for by Newton's method;
- `poses`, `turns` and `orientation` are shared by all subjects that have a pose;
- `registry` finds the auditors of a subject: `subjects/SUBJECT.py`, or a package of that name, with `KINDS`.
"""

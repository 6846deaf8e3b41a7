# What can be done with this repository.

_list:
    @just --list

# Install for work on it
install:
    python3 -m pip install -e '.[test]'

# Everything CI checks
check: lint types imports test

lint:
    ruff check . && ruff format --check .

format:
    ruff check --fix . && ruff format .

types:
    mypy

imports:
    lint-imports

test:
    pytest

# The tests with the lowest versions that pyproject.toml allows
lowest *tests:
    .ci/lowest {{tests}}

# Begin a new kind of question, and end it once it is filled in: just new-kind robot pseudo-inverse
new-kind subject kind:
    python3 -m tests.scaffold {{subject}} {{kind}}

# Mistakes planted into the code and the words, and what printed them: just mutants --count 500 --seed 1
mutants *options:
    python3 -m tests.mutants {{options}}

# One wrong sign in one printed line, six lines a module, and which were printed
lines *options:
    python3 -m tests.mutants lines {{options}}

# The same in sentences
sentences *options:
    python3 -m tests.mutants sentences {{options}}

# The same in tables
tables *options:
    python3 -m tests.mutants tables {{options}}

# Every exercise and example with other numbers, drawn by a seed: what is refused by a check of ours
shaken *options:
    python3 -m tests.shaken {{options}}

# Rebuild the golden pages after a change that is meant; of some sheets: just golden -k week3
golden *options:
    pytest tests/test_golden.py --update-golden {{options}}

# Every sheet in every format
sheets:
    derive exercises --format md,tex,pdf,html

# Costs as ratios to `import sympy`
bench:
    python3 -m benchmarks

# The documentation as a site, in site/
site:
    python3 -m mkdocs build --strict

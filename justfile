# What can be done with this repository.

# Install for work on it
install:
    python3 -m pip install -e '.[test]'

# Everything CI checks
check: lint types layers test

lint:
    ruff check . && ruff format --check .

format:
    ruff check --fix . && ruff format .

types:
    mypy

layers:
    lint-imports

test:
    pytest

# The tests with the lowest versions that pyproject.toml allows
lowest *tests:
    .ci/lowest {{tests}}

# Rebuild the golden pages after a change that is meant
golden:
    pytest tests/test_golden.py --update-golden

# Every sheet in every format
sheets:
    derive exercises --format md,tex,pdf,html

# Costs as ratios to `import sympy`
bench:
    python3 -m benchmarks

"""What derivations cost here and elsewhere, as ratios to `import sympy`: `python3 -m benchmarks`.

What is answered of every arm: `python3 -m benchmarks.grid`.
"""

"""What derivations cost here and elsewhere, as ratios to `import sympy`: `python3 -m benchmarks`."""

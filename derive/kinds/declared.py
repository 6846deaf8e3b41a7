"""The claims that a kind declares: those it makes on every sheet, so that none is ever forgotten.

A kind says `CLAIMS = ("symmetric", "torques")`, the keys of its claims, "a|b" where it makes the one or the
other; or, where they depend on the sheet, `claims_of(subject, options)`, which gives them.
"""

from __future__ import annotations

from dataclasses import replace
from types import ModuleType
from typing import Any

from derive.derivation import Claim, Derivation

UNDECLARED: tuple[str, ...] = ()


def declared(module: ModuleType, subject: Any, options: Any) -> tuple[str, ...]:
    """The keys of the claims that the answer to this question must make."""
    if hasattr(module, "claims_of"):
        return tuple(module.claims_of(subject, options))
    return getattr(module, "CLAIMS", UNDECLARED)


def with_all_claims(derivation: Derivation, module: ModuleType, subject: Any, options: Any) -> Derivation:
    """The same derivation, with a claim that fails for each one that was declared and is not made."""
    made = {claim.key for claim in derivation.claims}
    missing = [key for key in declared(module, subject, options) if made.isdisjoint(key.split("|"))]
    if not missing:
        return derivation
    failed = tuple(Claim("declared", "list-of-claims", False, {"key": key}, tried=0) for key in missing)
    return replace(derivation, claims=(*derivation.claims, *failed))

r"""The commands of TeX that are one character: what is printed for them, and how much room it has."""

from __future__ import annotations

from derive.render.formula.boxes import Kind, Sign
from derive.render.plain_text import LETTER_NAMES, LETTERS

_NAMED: dict[Kind, str] = {
    "binary": r"""
        cdot ⋅ times × div ÷ pm ± mp ∓ oplus ⊕ otimes ⊗ wedge ∧ land ∧ vee ∨ lor ∨ cap ∩ cup ∪ setminus ∖
        circ ∘ bullet ∙ star ⋆ ast ∗ dagger †
    """,
    "relation": r"""
        leq ≤ le ≤ geq ≥ ge ≥ ll ≪ gg ≫ neq ≠ ne ≠ equiv ≡ approx ≈ cong ≅ sim ∼ simeq ≃ propto ∝ parallel ∥
        perp ⊥ mid ∣ in ∈ notin ∉ ni ∋ subset ⊂ supset ⊃ subseteq ⊆ supseteq ⊇ implies ⟹ iff ⟺ to → gets ←
        mapsto ↦ rightarrow → leftarrow ← Rightarrow ⇒ Leftarrow ⇐ leftrightarrow ↔ Leftrightarrow ⇔
        longrightarrow ⟶ uparrow ↑ downarrow ↓
    """,
    "ordinary": r"""
        partial ∂ nabla ∇ infty ∞ emptyset ∅ angle ∠ triangle △ ell ℓ hbar ℏ imath ı jmath ȷ Re ℜ Im ℑ
        prime ′ forall ∀ exists ∃ neg ¬ top ⊤ bot ⊥ vert | Vert ‖ dots … ldots … cdots ⋯ vdots ⋮ ddots ⋱
        | ‖ % % # # & & _ _ $ $
    """,
    "large": "sum ∑ prod ∏ int ∫ oint ∮ iint ∬",
    "opening": r"{ { lbrace { langle ⟨ lvert | lVert ‖ lfloor ⌊ lceil ⌈",
    "closing": r"} } rbrace } rangle ⟩ rvert | rVert ‖ rfloor ⌋ rceil ⌉",
}
_TYPED: dict[Kind, str] = {
    "binary": "*∗ ×× ·⋅ ±±", "relation": "== << >> :: ≤≤ ≥≥ ≠≠ ≈≈ →→", "opening": "(( [[",
    "closing": ")) ]] !!", "punctuation": ",, ;;", "ordinary": "|| // .. ?? °° ∂∂ ∞∞",
}  # fmt: skip

GREEK = {"epsilon": "ϵ", "varpi": "ϖ", "varrho": "ϱ", "varsigma": "ς"} | dict(
    zip(LETTER_NAMES.split(" "), LETTERS, strict=True)
)
COMMANDS = {
    "\\" + name: Sign(char, kind)
    for kind, listed in _NAMED.items()
    for name, char in zip(listed.split()[::2], listed.split()[1::2], strict=True)
}
CHARACTERS = {
    typed: Sign(char, kind) for kind, pairs in _TYPED.items() for typed, char in map(tuple, pairs.split())
}
GAPS = {
    r"\,": 3 / 18, r"\:": 4 / 18, r"\;": 5 / 18, r"\!": -3 / 18, r"\ ": 0.25, "~": 0.25, r"\quad": 1.0,
    r"\qquad": 2.0,
}  # fmt: skip

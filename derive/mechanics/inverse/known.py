"""Which joint variables are known while the others are sought, and the angles in which to look for the next.

Angles about parallel axes come as sums: a planar arm knows theta1 + theta2 + theta3 before it knows any of
the three. So what is sought is a sum of neighbouring angles, or a displacement. In a parallelogram a row
turns by q3 - q2, and the sums of its rows are q2 and q3 themselves: there any sum or difference is sought.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction
from itertools import combinations, product

from derive.algebra.angles import Form, combination
from derive.algebra.ring import Ring, ring
from derive.mechanics.chain import Chain


@dataclass(frozen=True, slots=True)
class Knowledge:
    """`runs` are the revolute joints about parallel axes, with their senses; `forms` the sums that are
    known, `lengths` the displacements that are; `slides` all displacements. `coupled` says that a row turns
    by more than its own variable."""

    runs: tuple[Form, ...]
    slides: tuple[str, ...]
    forms: tuple[Form, ...] = ()
    lengths: frozenset[str] = field(default_factory=frozenset)
    coupled: bool = False

    @staticmethod
    def of(chain: Chain, variables: Iterable[str]) -> Knowledge:
        """Nothing known of these joint variables."""
        wanted = tuple(variables)
        turning = [j.variable for _, j in chain.moving if j.type == "revolute" and j.variable in wanted]
        slides = [j.variable for _, j in chain.moving if j.type == "prismatic" and j.variable in wanted]
        coupling = chain.coupling
        if coupling is None or not coupling.winds:
            return Knowledge(tuple(_runs(chain.T_tool.ring, turning)), tuple(slides))
        together = (*coupling.angles, *_parallel(chain))
        return Knowledge(tuple(_linked(together, turning)), tuple(slides), coupled=True)

    @property
    def joints(self) -> tuple[str, ...]:
        """The revolute joints."""
        return tuple(atom for run in self.runs for atom, _ in run.parts)

    def after(self, unknown: Form | str) -> Knowledge:
        """What is known once a sub-problem has given this sum of angles, or this displacement."""
        if isinstance(unknown, str):
            return replace(self, lengths=self.lengths | {unknown})
        return replace(self, forms=(*self.forms, unknown))

    def knows(self, form: Form) -> bool:
        """Whether a sum of angles follows from those known."""
        return combination(form, self.forms) is not None

    def knows_joint(self, name: str) -> bool:
        """Whether a joint variable is known."""
        return name in self.lengths if name in self.slides else determined(name, self.forms)

    @property
    def complete(self) -> bool:
        """Whether all of them are."""
        return all(map(self.knows_joint, (*self.joints, *self.slides)))

    def unknown_joints(self) -> frozenset[str]:
        """The joint variables still sought."""
        return frozenset(name for name in (*self.joints, *self.slides) if not self.knows_joint(name))

    def run_of(self, form: Form) -> Form:
        """The parallel joints a sum belongs to."""
        return next(run for run in self.runs if run.of_atom(form.parts[0][0]))

    def related(self, form: Form) -> frozenset[str]:
        """The joints that an equation in this sum may hold: parallel ones, and those of known sums."""
        known = (*self.forms, self.run_of(form))
        return frozenset(atom for each in known for atom, _ in self.run_of(each).parts)

    def sought(self) -> Iterator[Form]:
        """The sums of neighbouring angles not known yet, short ones first; of those that differ by a known
        one, the first."""
        found: list[Form] = []
        for form in sorted(self._neighbours(), key=lambda form: len(form.parts)):
            if self.knows(form) or any(self._same(form, other) for other in found):
                continue
            found.append(form)
            yield form

    def basis(self, form: Form | None) -> tuple[Form, ...]:
        """As many independent sums as there are joints: the known ones, the one sought, and single angles."""
        return completed((*self.forms, *([form] if form else [])), self.joints)

    def unknown_generators(self, form: Form | None) -> frozenset[str]:
        """The names of the generators that are not known, in the ring of that basis."""
        rest = self.basis(form)[len(self.forms) :]
        trig = [f"{function}({each})" for each in rest for function in ("cos", "sin")]
        return frozenset((*trig, *(name for name in self.slides if name not in self.lengths)))

    def home(self, form: Form | None, source: Ring) -> Ring:
        """A ring in these angles that holds the elements of another."""
        return ring((), self.basis(form), ()).union(source)

    def _neighbours(self) -> Iterator[Form]:
        for run in self.runs:
            if self.coupled:
                yield from _combinations(run)
                continue
            for start in range(len(run.parts)):
                for stop in range(start + 1, len(run.parts) + 1):
                    yield _positive(Form(run.parts[start:stop]))

    def _same(self, form: Form, other: Form) -> bool:
        return combination(form, (*self.forms, other)) is not None


def determined(joint: str, forms: Sequence[Form]) -> bool:
    """Whether these sums of angles determine a joint angle."""
    return combination(Form.of({joint: 1}), forms) is not None


def completed(forms: Sequence[Form], joints: Iterable[str]) -> tuple[Form, ...]:
    """The sums of angles, and single angles that do not follow from them: a basis for all of the joints."""
    found = list(forms)
    for joint in joints:
        if not determined(joint, found):
            found.append(Form.of({joint: 1}))
    return tuple(found)


def _positive(form: Form) -> Form:
    return form if form.parts[0][1] > 0 else form.scaled(-1)


def _runs(home: Ring, turning: list[str]) -> Iterator[Form]:
    """The longest sum of each set of parallel joints, its parts in the order of the joints."""
    longest: dict[str, Form] = {}
    for form in home.angles:
        names = [name for name in turning if form.of_atom(name)]
        for name in names:
            if name not in longest or len(longest[name].parts) < len(names):
                longest[name] = Form(tuple((each, form.of_atom(each)) for each in names))
    for form in dict.fromkeys(longest[name] for name in turning if name in longest):
        yield Form(tuple((name, Fraction(1 if n > 0 else -1)) for name, n in form.parts))


def _parallel(chain: Chain) -> Iterator[Form]:
    """Two joints together whose axes are parallel."""
    turning = [(joint.variable, chain.axis(i)) for i, joint in chain.moving if joint.type == "revolute"]
    for (one, first), (other, second) in combinations(turning, 2):
        if second in (first, -first):
            yield Form.of({one: 1, other: 1})


def _linked(angles: Iterable[Form], turning: list[str]) -> Iterator[Form]:
    """The joints that stand together in angles, in order: their axes are parallel."""
    groups: list[set[str]] = []
    for held in [{name} for name in turning] + [set(turning) & {a for a, _ in f.parts} for f in angles]:
        joined = [group for group in groups if group & held]
        groups = [group for group in groups if not group & held] + [held.union(*joined)]
    for group in sorted(filter(None, groups), key=lambda group: min(map(turning.index, group))):
        yield Form(tuple((name, Fraction(1)) for name in turning if name in group))


def _combinations(run: Form) -> Iterator[Form]:
    """Single angles, then sums and differences of all numbers of them, the first one positive."""
    names = [name for name, _ in run.parts]
    for size in range(1, len(names) + 1):
        for chosen in combinations(names, size):
            for signs in product((-1, 1), repeat=size - 1):
                yield Form.of(dict(zip(chosen, (1, *signs), strict=True)))


def singles(chain: Chain) -> Ring:
    """The chain's ring with every joint angle by itself."""
    source = chain.T_tool.ring
    forms: dict[Form, None] = {}
    for form in source.angles:
        if len(form.parts) == 1:
            forms[form] = None
        else:
            forms.update((Form.of({atom: 1}), None) for atom, _ in form.moving.parts)
    return ring((), tuple(forms), ()).union(source)

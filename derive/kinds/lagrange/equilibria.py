"""Where a system can stay at rest, and whether it does when disturbed."""

from __future__ import annotations

from collections.abc import Mapping

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.scalar import Scalar
from derive.algebra.signs import signed
from derive.derivation import Branch, Claim, Derivation, PageFacts, Phrase, Step, Table
from derive.errors import NotDerivable
from derive.expression import PI, ZERO, Expr, Symbol, free_symbols, walk
from derive.kinds.checks import law
from derive.kinds.fields import Evaluation, OptionsModel
from derive.kinds.lagrange._angles_found import Found, solved
from derive.kinds.lagrange._criterion import Criterion, criterion
from derive.kinds.lagrange._held import Still, held
from derive.kinds.lagrange._model import Model
from derive.kinds.lagrange._oracle import Differences
from derive.kinds.lagrange._rest import equations, inputs_of, require_steady, surely_positive, there
from derive.kinds.lagrange._rest_search import none_is_missing
from derive.kinds.lagrange._stiffness import is_exact, put_in
from derive.kinds.lagrange._stiffness import said as said_of
from derive.kinds.problem import Problem
from derive.kinds.work import Work
from derive.mechanics.lagrangian import TIME, LagrangianSystem, without

CLAIMS = ("as-told", "satisfies|needs-no-force|none-is-missing")
CLAIMED = {"solutions": "as-told"}


class Options(OptionsModel):
    """What holds the system."""

    inputs: Evaluation = None
    """Values of inputs that are not zero, such as a force that pushes all the time."""


class Facts(PageFacts):
    inputs: tuple[Symbol, ...]  # at zero
    given: tuple[tuple[Symbol, Expr], ...]
    table: Table | None  # of the states of rest, where there are some
    free: tuple[Symbol, ...]
    angles: bool
    criterion: Criterion


def derive(system: LagrangianSystem, options: Options, problem: Problem) -> Derivation:
    """Every rate zero, and every input without a value; stable where the potential energy is least.

    Goldstein et al., Classical Mechanics, section 6.1.

    Raises NotDerivable under constraints, and where the equations have no exact or isolated solution.
    """
    if system.constraints:
        raise NotDerivable(
            "under constraints no equilibria are looked for; take coordinates that are free", "constraints"
        )
    model = Model(system, problem)
    positive = {n for n, what in problem.assumptions.items() if what == "positive"} | surely_positive(model)
    given = _inputs(model, options)
    left = _at_rest(model, given)
    found = solved([each for each in left if each], system.coordinates, positive, problem)
    stiffness = ScalarMatrix.of([row.diff(q) for q in system.coordinates] for row in left)
    said = [said_of(model, each, stiffness, positive) for each in found]
    steps = (
        *(
            Step(f"rest_{k}", (problem.readable(each), ZERO), "in-numbers")
            for k, each in enumerate(left, 1)
            if each
        ),
        Step("K", (Symbol("K"), _written(stiffness, problem)), "stiffness"),
    )
    branches = tuple(_branch(system, each, words) for each, words in zip(found, said, strict=True))
    work = Work(problem, uses=(equations(problem),), steps=steps)
    for k, each in enumerate(found, 1):
        if is_exact(each):
            work = work.claim(_put_back(model, left, each, k, positive))
    still, free = Still(Differences(system, problem.where), given), [each.free for each in found]
    stands = criterion(model, said)
    work = work.claim(*held(still, problem, steps, branches, stands.effective))
    work = work.claim(*none_is_missing(still, problem, steps, branches, free))
    table = _table(system, branches) if branches else None
    if table:
        values = [(*branch.values.values(), branch.when) for branch in branches]
        work = work.law("listed", values == [*table.rows])
    told_of = given.items() if any(left) else ()
    facts = Facts(
        inputs=tuple(name for name, value in told_of if value == ZERO),
        given=tuple((name, value) for name, value in told_of if value not in (ZERO, name)),
        table=table,
        free=tuple(Symbol(q) for q in dict.fromkeys(q for each in found for q in each.free)),
        angles=any(PI in walk(tree) for branch in branches for tree in branch.values.values()),
        criterion=stands,
    )
    return work.answer("equilibria", {"solutions": branches}, facts)


def _inputs(model: Model, options: Options) -> dict[Symbol, Expr]:
    """The inputs with their values, zero unless given. Raises NotDerivable for a name that is none."""
    given = dict(options.inputs or ())
    names = inputs_of(model)
    forces = frozenset().union(*(free_symbols(tree) for _, tree in model.system.forces))
    if unknown := sorted(given.keys() - forces):
        raise NotDerivable(f"{unknown[0]} under inputs: is none of the inputs ({', '.join(names)})", "inputs")
    require_steady(given, (*model.system.coordinates, *model.system.rates, *model.system.accelerations))
    return {Symbol(name): given.get(name, ZERO) for name in dict.fromkeys((*names, *given))}


def _at_rest(model: Model, given: Mapping[Symbol, Expr]) -> list[Scalar]:
    """The left sides less the forces, with every rate zero and the inputs as given."""
    system = model.system
    nothing = (*system.rates, *(name.name for name, value in given.items() if value == ZERO))
    found = [without(model.rest[k] - model.forces[q], nothing) for k, q in enumerate(system.coordinates)]
    held = dict[Expr, Expr]({name: value for name, value in given.items() if value not in (ZERO, name)})
    found = [there(model, each, held) for each in found] if held else found
    if any(TIME in each.letters() for each in found):
        raise NotDerivable("the forces change with the time: the system has no state of rest", "forces")
    return found


def _written(stiffness: ScalarMatrix, problem: Problem) -> Expr:
    """A matrix, or the entry of one."""
    whole = problem.readable_matrix(stiffness)
    return whole if len(whole.rows) > 1 else whole.rows[0][0]


def _branch(system: LagrangianSystem, found: Found, said: Phrase) -> Branch:
    values = {q: found.values.get(q, Symbol(q)) for q in system.coordinates}
    return Branch(values, (said,))


def _table(system: LagrangianSystem, branches: tuple[Branch, ...]) -> Table:
    rows = tuple((*branch.values.values(), branch.when) for branch in branches)
    return Table((*map(Symbol, system.coordinates), Phrase("at-rest")), rows)


def _put_back(model: Model, left: list[Scalar], found: Found, k: int, positive: set[str]) -> Claim:
    holds = not any(signed(put_in(model, each, found), positive) for each in left)
    return law("satisfies", holds, k=k)

"""Plots and diagrams: nothing lies on anything else, and what is drawn agrees with SciPy and NumPy."""

from __future__ import annotations

import random
import subprocess
import sys
from collections.abc import Callable, Iterator
from dataclasses import replace
from functools import cache
from importlib import import_module
from itertools import combinations, pairwise
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy import integrate, signal

from derive.build import assemble
from derive.derivation import Drawing, Figure, Panels, Plot
from derive.errors import SheetErrors
from derive.expression import Approximate, Relation, Symbol
from derive.figures.loops import Pictured
from derive.render.drawing.axes import Frame
from derive.render.drawing.placing import Box
from derive.render.drawing.plots import framed, sketched
from derive.render.drawing.style import SERIES, series_pen
from derive.render.drawing.subjects import laid_out
from derive.render.phrases import sign_of
from derive.sheet.load import load_sheet

EXERCISES = Path(__file__).parents[2] / "exercises"
SHEETS = ("dc-motor", "planar-2r", "trajectories", "plants")
MOTOR = {"J": 2.0, "K_m": 10.0, "R_a": 1.0, "L_a": 1.0, "b": 0.5, "K_b": 0.1}
MORE = """\
title: More
problems:
- robot:
    links:
    - {theta: theta1*, d: 0, a: 0.5 m, alpha: 0}
    - {theta: theta2*, d: 0, a: 0.4 m, alpha: 0}
    - {theta: theta3*, d: 0, a: 0.2 m, alpha: 0}
  questions:
  - find: workspace
  - {find: manipulability, rows: [vx, vy], evaluate: {theta1: 10 deg, theta2: 70 deg, theta3: -50 deg}}
- robot:
    links:
    - {theta: theta1*, d: 0.4 m, a: 0.1 m, alpha: 90 deg}
    - {theta: theta2*, d: 0, a: 0.6 m, alpha: 0}
    - {theta: theta3*, d: 0, a: 0.5 m, alpha: 0}
  find: workspace
- {system: {equations: ["(s + 1)*y = (1 - s)*u"], input: u, output: y}, find: step-response}
- {system: {equations: ["(s^2 + 0.02*s + 1)*y = -3*u"], input: u, output: y}, find: step-response}
- {system: {equations: ["(s - 1)*y = u"], input: u, output: y}, find: step-response}
- {system: {equations: ["(s + 2)*y = s*u"], input: u, output: y}, find: step-response}
- system: {equations: ["(s^2 + 3*s + 2)*y = (s + 5)*u"], input: u, output: y}
  questions:
  - {find: closed-loop, controller: {PID: {K_p, K_i, K_d}}}
  - {find: model, controller: {PID: {K_p: 1, K_i: 2, K_d: 0.3}}}
- system:
    equations: ["m*s^2*x_1 = F - (c*s + k)*(x_1 - x_2)", "M*s^2*x_2 = (c*s + k)*(x_1 - x_2)", "w = x_1 + x_2"]
    input: F
    output: w
  questions:
  - find: transfer-function
  - {find: closed-loop, controller: PI}
"""


@cache
def figures() -> dict[str, Figure]:
    """Every figure of the sheets, by its path."""
    found: dict[str, Figure] = {}
    for name in SHEETS:
        found |= assemble(load_sheet(EXERCISES / f"{name}.yaml")).plots()
    return found


@pytest.fixture(scope="module")
def more(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Figure]:
    sheet = tmp_path_factory.mktemp("more") / "more.yaml"
    sheet.write_text(MORE, encoding="utf-8")
    return assemble(load_sheet(sheet)).plots()


def plots(found: dict[str, Figure]) -> Iterator[tuple[str, Plot | Panels]]:
    for name, figure in found.items():
        if not isinstance(figure, Drawing):
            yield name, figure


def test_no_text_lies_on_another(more: dict[str, Figure]) -> None:
    for name, figure in plots({**figures(), **more}):
        texts = sketched(figure).texts
        for one, other in combinations(texts, 2):
            assert not one.box.meets(other.box), (name, one.what.content, other.what.content)


def test_no_name_inside_the_axes_lies_on_a_curve(more: dict[str, Figure]) -> None:
    for name, figure in plots({**figures(), **more}):
        if isinstance(figure, Panels) or figure.equal:
            continue
        frame = framed(figure, 150.0)
        inside = [t for t in sketched(figure).texts if t.box.left > 0 and t.box.low > 0 and not t.turned]
        for curve in figure.series.values():
            places = [frame.at(place) for place in zip(*curve, strict=True)]
            for text in inside:
                assert not any(text.box.crossed(a, b) for a, b in pairwise(places)), name


def blocks_of(diagram: Drawing) -> list[Box]:
    """Blocks and sums."""
    places = [stroke.places for stroke in diagram.strokes if stroke.role == "box"]
    return [Box(*(f(p[k] for p in each) for f in (min, max) for k in (0, 1))) for each in places]


def check_diagram(diagram: Drawing) -> None:
    """With the room that Typst gives its labels: these are inside their blocks, apart from each other; blocks
    are apart, and no wire runs through one."""
    laid, blocks = laid_out(diagram), blocks_of(diagram)
    for caption, label in zip(diagram.captions, laid.boxes, strict=True):
        room = label.grown(2.0)
        assert caption.role != "block" or any(
            b.left < room.left and room.right < b.right and b.low < room.low and room.high < b.high
            for b in blocks
        )
    for one, other in combinations(laid.boxes, 2):
        assert not one.meets(other)
    for one, other in combinations(blocks, 2):
        assert not one.meets(other)
    for stroke in diagram.strokes:
        for a, b in pairwise(stroke.places if stroke.role == "arrow" else ()):
            assert not any(block.grown(-1.0).crossed(a, b) for block in blocks)


def test_diagrams_can_be_read(more: dict[str, Figure]) -> None:
    diagrams = [f for f in {**figures(), **more}.values() if isinstance(f, Drawing) and f.unit]
    assert len(diagrams) > 5
    for diagram in diagrams:
        check_diagram(diagram)


def equations(draw: random.Random) -> str:
    """A chain of signals from u to the last, with feedback, bypasses and a disturbance."""
    names = [f"x_{k}" for k in range(1, draw.randint(3, 6))]
    found = []
    for k, name in enumerate(names):
        left = draw.choice((name, f"(s + a_{k})*{name}", f"(m_{k}*s^2 + b_{k}*s)*{name}", f"s*{name}"))
        others = draw.sample([each for each in (*names, "u", "d") if each != name], draw.randint(0, 2))
        inputs = dict.fromkeys(("u" if k == 0 else names[k - 1], *others))
        right = " ".join(f"{draw.choice('+-')} {draw.choice((f'K_{k}', '2', '1'))}*{each}" for each in inputs)
        found.append(f'"{left} = 0 {right}"')
    last = f"input: u, output: {names[-1]}"
    return (
        f"{{equations: [{', '.join(found)}], {last}{', disturbance: d' if '*d' in ''.join(found) else ''}}}"
    )


@pytest.mark.parametrize("seed", range(12))
def test_a_diagram_that_is_drawn_can_be_read(tmp_path: Path, seed: int) -> None:
    """Of any system: what could not be read is drawn as one block, or not at all."""
    sheet = tmp_path / "x.yaml"
    system = equations(random.Random(seed))
    questions = "[{find: transfer-function}, {find: closed-loop, controller: PID}]"
    sheet.write_text(
        f"title: x\nproblems:\n- {{system: {system}, questions: {questions}}}\n", encoding="utf-8"
    )
    try:
        drawn = assemble(load_sheet(sheet)).plots().values()
    except SheetErrors:  # of such a system there is no answer
        return
    assert drawn
    for diagram in drawn:
        assert isinstance(diagram, Drawing)
        check_diagram(diagram)


def closed_loop(gains: tuple[float, float, float]) -> signal.TransferFunction:
    """The motor of the exercises with a PID controller."""
    k_p, k_i, k_d = gains
    m = MOTOR
    den = np.polymul([m["J"], m["b"], 0.0], [m["L_a"], m["R_a"]]) + np.array([0, 0, m["K_m"] * m["K_b"], 0])
    num = m["K_m"] * np.trim_zeros(np.array([k_d, k_p, k_i]), "f")
    return signal.TransferFunction(num, np.polyadd(np.polymul(den, [1.0, 0.0]), num))


@pytest.mark.parametrize(
    ("question", "gains"), [(2, (0.05, 0.0, 0.0)), (4, (0.1, 0.0, 0.15)), (6, (0.12, 0.01, 0.15))]
)
def test_marks_of_step_responses_agree_with_scipy(question: int, gains: tuple[float, float, float]) -> None:
    plot = figures()[f"dc-motor/problem-2-{question}-step"]
    assert isinstance(plot, Plot)
    ((times, values),) = plot.series.values()
    _, y = signal.step(closed_loop(gains), T=np.array(times))
    assert np.allclose(values, y, atol=1e-6)
    marks = {str(span.label).split()[0]: span for span in plot.spans}
    rise, settling, overshoot = (marks[name] for name in ("rise", "settling", "overshoot"))
    fine = np.linspace(0, times[-1], 400_000)
    _, y = signal.step(closed_loop(gains), T=fine)
    assert overshoot.start[0] == pytest.approx(fine[y.argmax()], abs=1e-3)
    assert overshoot.end[1] == pytest.approx(y.max(), abs=1e-6)
    assert rise.start[0] == pytest.approx(fine[(y >= 0.1).argmax()], abs=1e-3)
    assert rise.end[0] == pytest.approx(fine[(y >= 0.9).argmax()], abs=1e-3)
    assert settling.end[0] == pytest.approx(fine[np.flatnonzero(abs(y - 1) > 0.02)[-1]], abs=1e-3)


def test_a_motion_is_the_integral_of_its_acceleration() -> None:
    drawn = 0
    for name, figure in plots(figures()):
        if not name.startswith("trajectories") or not isinstance(figure, Panels):
            continue
        position, velocity, acceleration = figure.plots
        for label in position.series:
            t, q = (np.array(each) for each in position.series[label])
            _, v = (np.array(each) for each in velocity.series[label])
            _, a = (np.array(each) for each in acceleration.series[label])
            size = abs(q).max() + abs(v).max() + abs(a).max()
            assert np.allclose(integrate.cumulative_trapezoid(a, t, initial=0) + v[0], v, atol=2e-4 * size)
            assert np.allclose(integrate.cumulative_trapezoid(v, t, initial=0) + q[0], q, atol=2e-4 * size)
            drawn += 1
        assert position.moments == velocity.moments == acceleration.moments
        assert max(position.moments.values()) == pytest.approx(t[-1])
    assert drawn > 12


def test_switching_times_are_where_the_acceleration_jumps() -> None:
    panels = figures()["trajectories/problem-1-1-profile"]
    assert isinstance(panels, Panels)
    ((times, values),) = panels.plots[2].series.values()
    jumps = [t for t, before, after in zip(times[1:], values, values[1:], strict=False) if before != after]
    assert [*panels.plots[2].moments.values()] == pytest.approx([*jumps, times[-1]])
    assert [*panels.plots[0].moments] == ["$t_1 = 0.5$", "$t_2 = 1.5$", "$t_3 = 2$"]


def test_the_ellipse_is_the_image_of_the_circle() -> None:
    """By differences of the position of the tip of the arm that is drawn."""
    panels = figures()["planar-2r/problem-1-8-ellipsoids"]
    assert isinstance(panels, Panels)
    circle, ellipse = panels.plots
    ((xs, ys),) = ellipse.arms.values()
    links = np.diff(np.array([xs, ys])).T
    turned = [np.array([-w, u]) for u, w in links]
    J = np.column_stack((turned[0] + turned[1], turned[1]))
    scale = float(str(next(iter(ellipse.series))).split("drawn as ")[1].split()[0])
    drawn = np.array(next(iter(ellipse.series.values()))) - np.array([[xs[-1]], [ys[-1]]])
    rates = np.linalg.solve(J, drawn / scale)
    assert np.allclose(np.linalg.norm(rates, axis=0), 1.0)
    for (_, rate), (start, end) in zip(circle.arrows.values(), ellipse.arrows.values(), strict=True):
        assert np.allclose(scale * J @ np.array(rate), np.subtract(end, start))


def test_workspaces_and_errors(more: dict[str, Figure]) -> None:
    plane = more["more/problem-1-1-workspace"]
    assert isinstance(plane, Plot)
    radii = [np.hypot(*np.array(curve)) for curve in plane.series.values()]
    assert np.allclose(radii[0], 1.1)  # 0.5 + 0.4 + 0.2; no hole
    _, *any_way = [np.hypot(*np.array(curve)) for curve in plane.regions.values()]
    # the last link has to begin between 0.1 and 0.9, whichever way it points
    assert [(min(r), max(r)) for r in any_way] == [pytest.approx((0.0, 0.1)), pytest.approx((0.3, 0.7))]
    errors = figures()["planar-2r/problem-2-1-error"]
    assert isinstance(errors, Plot) and errors.log and errors.counted
    frame: Frame = framed(errors, 150.0)
    assert all(tick == int(tick) for tick in frame.x.ticks(30.0, whole=True))
    assert {round(np.log10(tick), 9) % 1 for tick in frame.y.ticks(20.0)} == {0.0}


def test_curves_are_known_apart_in_grey() -> None:
    assert len({series_pen(k).dash for k in range(len(SERIES))}) == len(SERIES)


def test_a_picture_loads_no_plotting_library(tmp_path: Path) -> None:
    run = (
        "import sys; from pathlib import Path; from derive.build import build\n"
        f"build([Path({str(EXERCISES / 'trajectories.yaml')!r})], ['md'], Path({str(tmp_path)!r}))\n"
        "assert not {'matplotlib', 'scipy', 'sympy'} & {*sys.modules}"
    )
    subprocess.run([sys.executable, "-c", run], check=True)


def later(plot: Plot) -> Plot:
    """With a mark that is somewhere else."""
    first, *others = plot.spans
    return replace(plot, spans=(replace(first, end=(1.1 * first.end[0], first.end[1])), *others))


def larger(panels: Panels) -> Panels:
    """With ellipses that are too large."""
    *before, plot = panels.plots
    series = {name: (tuple(1.01 * x for x in xs), ys) for name, (xs, ys) in plot.series.items()}
    return replace(panels, plots=(*before, replace(plot, series=series)))


def unlike(picture: Pictured) -> Pictured:
    """With another sign in a sum."""
    blocks = [replace(b, signs=(1,) * len(b.signs)) for b in picture.diagram.blocks]
    return replace(picture, diagram=replace(picture.diagram, blocks=tuple(blocks)))


STEP = "{system: {equations: ['(s + 1)*y = u'], input: u, output: y}, find: step-response}"
LOOP = "{system: {equations: ['(s + 1)*y = u'], input: u, output: y}, find: closed-loop, controller: P}"
ROWS = "[{theta: theta1*, d: 0, a: 1, alpha: 0}, {theta: theta2*, d: 0, a: 1, alpha: 0}]"
ARM = f"{{robot: {{links: {ROWS}}}, find: manipulability, evaluate: {{theta1: 0.1, theta2: 1}}}}"
WAVE = "{sensor: {pwm: 12 V, duty: 40%}, find: mean-voltage}"


@pytest.mark.parametrize(
    ("problem", "place", "slip"),
    [
        (STEP, "system.step_response.stepped", later),
        (LOOP, "system.closed_loop.looped", unlike),
        (ARM, "robot._velocity.ellipsoids.at_the_tip", larger),
        (WAVE, "sensor.mean_voltage.switched", lambda plot: replace(plot, marks={"": 5.0})),
    ],
)
def test_what_is_drawn_wrongly_is_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, problem: str, place: str, slip: Callable[[Any], Any]
) -> None:
    sheet = tmp_path / "x.yaml"
    sheet.write_text(f"title: x\nproblems:\n- {problem}\n", encoding="utf-8")
    assemble(load_sheet(sheet))
    module, _, name = f"derive.kinds.{place}".rpartition(".")
    right = getattr(import_module(module), name)
    monkeypatch.setattr(f"{module}.{name}", lambda *given: slip(right(*given)))
    with pytest.raises(SheetErrors) as caught:
        assemble(load_sheet(sheet))
    assert "its own check" in caught.value.errors[0].message


def test_what_is_shown_with_all_its_digits_is_equal() -> None:
    half, eighth = (Relation(Symbol("t"), "=", Approximate(value)) for value in (0.5, 0.125))
    assert [sign_of(half, 2), sign_of(eighth, 3), sign_of(eighth, 2)] == ["=", "=", r"\approx"]

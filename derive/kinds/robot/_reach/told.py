"""What the words say of a workspace: the arm, what it reaches, and what of that in any orientation."""

from __future__ import annotations

from derive.derivation import Phrase, Said
from derive.expression import ZERO, Call, Relation, Symbol
from derive.kinds.robot._reach.regions import Region, Secondary
from derive.kinds.robot._reach.shapes import Shape

LAST_LINK = ("last-link-within", "last-link-anywhere")
R_MIN, R, R_MAX = Symbol("r_min"), Symbol("r"), Symbol("r_max")


def arm_told(region: Region, pair: tuple[int, ...]) -> Phrase:
    """How it is built; `pair` are the joints of the links that move in a plane."""
    about: dict[str, Said] = {"lengths": region.lengths}
    if region.kind == "planar":
        if len(region.lengths) == 1:
            return Phrase("single-link-sliding" if region.slides else "single-link", about)
        about["hole"] = Phrase("hole-of-two" if len(region.lengths) == 2 else "hole-of-more")
        return Phrase("parallel-axes-sliding" if region.slides else "parallel-axes", about)
    about |= {"pair": pair, "offset": region.offset, "side": region.side}
    if region.kind == "swung":
        return Phrase("swung" if region.side == ZERO else "swung-aside", about)
    return Phrase("torus" if region.side == ZERO else "torus-aside", about)


def region_told(region: Region, closed: bool) -> Phrase:
    """What it reaches; there is no hole where it is `closed`."""
    match region.kind, len(region.lengths):
        case "planar", 1:
            return Phrase("side-of-a-cylinder" if region.slides else "circle")
        case "planar", _ if region.slides:
            return Phrase("cylinder" if closed else "hollow-cylinder")
        case "planar", _:
            return Phrase("disc" if closed else "annulus")
        case "torus", _:
            return Phrase("swung-annulus")
    ball = Phrase("ball" if closed else "hollow-ball")
    return ball if region.side == ZERO else Phrase("bored-through", {"ball": ball})


def equal_lengths(region: Region) -> tuple[Symbol, Symbol] | None:
    """The lengths of two links that reach their base where they are equal; none where that is decided."""
    match region.lengths:
        case (Symbol() as one, Symbol() as other) if one != other:
            return (one, other) if (region.offset, region.side) == (ZERO, ZERO) else None
    return None


def closed_where(region: Region) -> Phrase | None:
    """For which lengths the region has no hole, or what it is if it has none."""
    if (lengths := equal_lengths(region)) is None:
        open_ = isinstance(region.smallest[-1], Call) and region.smallest[-1].function == "max"
        return Phrase("closed-else", {"region": region_told(region, True)}) if open_ else None
    return Phrase(
        "closed-where", {"equal": Relation(lengths[0], "=", lengths[1]), "region": region_told(region, True)}
    )


def orientations_told(
    region: Region, closed: bool, spare: tuple[int, ...], free: bool, secondary: Secondary | None
) -> Phrase:
    """Where every orientation is possible; joints that are `spare` do not move the point, and give it any
    orientation where they are `free`."""
    if free:
        return Phrase("both-the-same-by-one" if len(spare) == 1 else "both-the-same", {"spare": spare})
    if secondary:
        about: dict[str, Said] = {
            "r": R, "last": region.lengths[-1], "far": secondary.far, "inside": secondary.inside,
            "gap": secondary.gap,
        }  # fmt: skip
        return _last_link(about)
    if region.kind == "planar" and len(region.lengths) == 2:
        if lengths := equal_lengths(region):
            return Phrase("two-orientations-or-the-base", {"equal": Relation(lengths[0], "=", lengths[1])})
        return Phrase("the-base-alone" if closed else "two-orientations")
    if region.kind != "planar" and (spare or len(region.lengths) > 2):
        return _missing(spare, len(region.lengths) > 2)
    if len(region.lengths) > 2:
        return Phrase("no-wrist" if spare else "too-few-joints")
    return _no_more(spare, region.kind == "planar")


def _no_more(spare: tuple[int, ...], planar: bool) -> Phrase:
    """Why it does not turn as one likes where three joints at most move the point: in space all three would
    have to leave it where it is."""
    if spare:
        return Phrase("no-wrist")
    return Phrase("no-joint-left" if planar else "no-freedom-left")


def _last_link(about: dict[str, Said]) -> Phrase:
    """Where the last link starts from; without a hole in the reach of the others there is no gap."""
    if about["gap"] != ZERO:
        return Phrase("last-link-within", about)
    return Phrase("last-link-anywhere", {name: about[name] for name in ("r", "last", "far")})


def _missing(spare: tuple[int, ...], idle: bool) -> Phrase:
    """Why joints that are `spare` do not give every orientation in space; another one is `idle` where it may
    move although the point stays."""
    if len(spare) + idle < 3:
        return Phrase("too-few-joints")
    return Phrase("no-wrist" if len(spare) == 3 and not idle else "orientations-open")


def shape_orientations(shape: Shape, spare: tuple[int, ...], free: bool, planar: bool) -> Phrase:
    """The same within limits; joints that are `spare` give any orientation where they are `free`."""
    if free:
        return Phrase("both-the-same-by-one" if len(spare) == 1 else "both-the-same", {"spare": spare})
    if shape.kind == "box":
        return _missing(spare, idle=False) if spare else Phrase("never-turned")
    if shape.gap is not None and shape.turn is None and planar and not spare:
        link = shape.link
        about: dict[str, Said] = {
            "r": R, "last": link, "far": shape.far_start, "inside": Call("abs", (R - link,)), "gap": shape.gap
        }  # fmt: skip
        return _last_link(about)
    if len(shape.rows) <= (2 + bool(shape.lift) if planar else 3):
        if spare and not planar:
            return _missing(spare, idle=False)
        return _no_more(spare, planar)
    return Phrase("orientations-open")

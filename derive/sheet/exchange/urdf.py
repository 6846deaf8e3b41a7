"""A robot description in URDF as values: links with their bodies, joints with their frames and limits."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from typing import TypeVar

from derive.sheet.exchange.elements import Element
from derive.sheet.exchange.rigid import ORIGIN, Mass, Pose, Vector, product, rotation, transposed, vector
from derive.sheet.exchange.values import exact
from derive.sheet.source import Faults

TURNING = ("revolute", "continuous")
JOINTS = (*TURNING, "prismatic", "fixed")
T = TypeVar("T")


@dataclass(frozen=True, slots=True)
class Origin:
    """Where a frame stands: a displacement (m), then roll, pitch and yaw (rad)."""

    xyz: Vector
    rpy: Vector

    def pose(self, within: float) -> Pose:
        """As a pose; angles as near to a simple one as `within` (rad) are that one."""
        return Pose(rotation(self.rpy, within), self.xyz)


@dataclass(frozen=True, slots=True)
class Inertial:
    """A body: mass, where its centre stands and how its axes lie, and its moments in those axes."""

    mass: Fraction
    origin: Origin
    moments: tuple[Vector, Vector, Vector]
    element: Element

    def body(self, within: float) -> Mass:
        """In the frame of its link."""
        pose = self.origin.pose(within)
        return Mass(self.mass, pose.p, product(product(pose.R, self.moments), transposed(pose.R)))


@dataclass(frozen=True, slots=True)
class Mimic:
    """A joint that follows another: multiplier * joint + offset."""

    joint: str
    multiplier: Fraction
    offset: Fraction
    element: Element


@dataclass(frozen=True, slots=True)
class Joint:
    """A joint from one link to another, about or along `axis` in its own frame."""

    name: str
    type: str
    parent: str
    child: str
    origin: Origin
    axis: Vector
    limits: tuple[Fraction, Fraction] | None
    damping: Fraction
    friction: Fraction
    mimic: Mimic | None
    element: Element

    @property
    def moves(self) -> bool:
        """Whether it is no fixed one."""
        return self.type != "fixed"


@dataclass(frozen=True, slots=True)
class Model:
    """A tree of links: the joint that leads to each, and the body that it carries."""

    name: str
    root: str
    links: dict[str, Inertial | None]
    joints: dict[str, Joint]  # by the link to which it leads
    element: Element

    def children(self, link: str) -> list[Joint]:
        """The joints that start at a link, in the order of the file."""
        return [joint for joint in self.joints.values() if joint.parent == link]

    def path(self, link: str) -> tuple[Joint, ...]:
        """The joints from the root to a link."""
        found: list[Joint] = []
        while link in self.joints:
            found.append(self.joints[link])
            link = found[-1].parent
        return tuple(reversed(found))


def model(root: Element) -> Model:
    """The robot. Raises SheetErrors with every fault of the file."""
    if root.tag != "robot":
        raise root.error(f"a robot description starts with <robot>, not <{root.tag}>")
    faults = Faults()
    links = _named(root.all("link"), _link, faults)
    joints = _named(root.all("joint"), _joint, faults)
    faults.settle()
    if not links:
        raise root.error("this robot has no <link>")
    leading: dict[str, Joint] = {}
    for joint in joints.values():
        for tag, link in (("parent", joint.parent), ("child", joint.child)):
            if link not in links:
                faults.append(joint.element.need(tag).fault(f"there is no link '{link}'", attribute="link"))
        if joint.child in leading:
            message = f"link '{joint.child}' hangs on joint '{leading[joint.child].name}' already"
            faults.append(joint.element.need("child").fault(message, "an open chain has no loops", "link"))
        leading.setdefault(joint.child, joint)
        if joint.mimic and joint.mimic.joint not in joints:
            faults.append(joint.mimic.element.fault(f"there is no joint '{joint.mimic.joint}'", "", "joint"))
    faults.settle()
    return Model(root.attributes.get("name", "").strip(), _base(root, links, leading), links, leading, root)


def _base(root: Element, links: dict[str, Inertial | None], leading: dict[str, Joint]) -> str:
    free = [link for link in links if link not in leading]
    if len(free) != 1:
        told = " and ".join(free[:3]) or "none: they hang on each other in a circle"
        raise root.error(f"one link of a robot hangs on no joint; here {told}", "join them by a fixed joint")
    for link in links:  # a circle beside the tree is reached from no link
        seen = {link}
        while link in leading:
            link = leading[link].parent
            if link in seen:
                raise leading[link].element.error(f"joint '{leading[link].name}' closes a circle of links")
            seen.add(link)
    return free[0]


def _named(found: list[Element], read: Callable[[Element], T], faults: Faults) -> dict[str, T]:
    """What was read, by name; the faults of all are gathered."""
    values: dict[str, T] = {}
    for element in found:
        with faults.gathered():
            name = element.text("name")
            if name in values:
                raise element.error(f"there is a {element.tag} '{name}' already", attribute="name")
            values[name] = read(element)
    return values


def _link(element: Element) -> Inertial | None:
    if (inertial := element.one("inertial")) is None:
        return None
    mass = _number(inertial.need("mass"), "value")
    if mass < 0:
        raise inertial.need("mass").error("no body has a negative mass", attribute="value")
    of = inertial.need("inertia")
    xx, xy, xz, yy, yz, zz = (_number(of, f"i{each}", "0") for each in ("xx", "xy", "xz", "yy", "yz", "zz"))
    return Inertial(mass, _origin(inertial), ((xx, xy, xz), (xy, yy, yz), (xz, yz, zz)), inertial)


def _joint(element: Element) -> Joint:
    name, kind = element.text("name"), element.text("type")
    if kind not in JOINTS:
        hint = f"{', '.join(JOINTS)} are read; put it together of these"
        raise element.error(f"joint '{name}' is {kind}, which no row of an arm is", hint, "type")
    limit, dynamics, axis = element.one("limit"), element.one("dynamics"), element.one("axis")
    direction = _vector(axis, "xyz") if axis else vector(map(Fraction, (1, 0, 0)))
    if not any(direction) and kind != "fixed":
        raise (axis or element).error("an axis of zero length has no direction", attribute="xyz")
    return Joint(
        name,
        kind,
        element.need("parent").text("link"),
        element.need("child").text("link"),
        _origin(element),
        direction,
        _limits(limit) if limit and kind in ("revolute", "prismatic") else None,
        _number(dynamics, "damping", "0") if dynamics else Fraction(0),
        _number(dynamics, "friction", "0") if dynamics else Fraction(0),
        _mimic(element.one("mimic")),
        element,
    )


def _limits(limit: Element) -> tuple[Fraction, Fraction] | None:
    """None where nothing is said: both are zero."""
    low, high = _number(limit, "lower", "0"), _number(limit, "upper", "0")
    if low > high:
        raise limit.error("the lower limit is above the upper one", attribute="lower")
    return (low, high) if low < high else None


def _mimic(mimic: Element | None) -> Mimic | None:
    if mimic is None:
        return None
    return Mimic(mimic.text("joint"), _number(mimic, "multiplier", "1"), _number(mimic, "offset", "0"), mimic)


def _origin(element: Element) -> Origin:
    origin = element.one("origin")
    return Origin(_vector(origin, "xyz"), _vector(origin, "rpy")) if origin else Origin(ORIGIN, ORIGIN)


def _vector(element: Element, name: str) -> Vector:
    words = element.attributes.get(name, "0 0 0").split()
    if len(words) != 3:
        raise element.error(f"'{name}' is three numbers", attribute=name)
    return vector([_value(element, name, word) for word in words])


def _number(element: Element, name: str, default: str | None = None) -> Fraction:
    typed = element.text(name) if default is None else element.attributes.get(name, default).strip()
    return _value(element, name, typed)


def _value(element: Element, name: str, typed: str) -> Fraction:
    try:
        return exact(typed)
    except ValueError:
        message = f"'{typed[:40]}' is no number" + (" of this size" if typed[:1].isdigit() else "")
        raise element.error(message, attribute=name) from None

"""Faults of pydantic's, retold: what is wrong, where in the file, what to write instead."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence, Set
from difflib import SequenceMatcher, get_close_matches
from typing import Any

from pydantic import TypeAdapter, ValidationError

from derive.errors import FormulaError, SheetError, position
from derive.sheet.branches import branches, keys, lengths, purpose
from derive.sheet.cut import before, cut_fault, cut_off
from derive.sheet.other_words import our_word
from derive.sheet.source import At, Route

MOST = 100  # faults of one value that are told one by one
EXAMPLE = re.compile(r"\bas (?P<like>\[.*?\]|\{.*?\})")  # of what may stand in a field, in what is said of it
OBJECT = re.compile(r"(?P<object>\{\w+: [^{}]*\})")  # likewise, in what is said of a model
NAMED = re.compile(r"(\w+) \(([^)]*)\)")  # a choice, and whose it is
NO_FORM = "no_form"  # the type of a fault where a value has none of the forms it could have
OTHER_FORM = frozenset({"list_type", "tuple_type", "dict_type"})  # a value of one form had a list as another
WANTED = {
    "int": "a whole number is wanted here",
    "float": "a number is wanted here",
    "bool": "true or false is wanted here",
    "string": "text is wanted here",
    "list": "a list is wanted here",
    "tuple": "a list is wanted here",
    "dict": "keys with values are wanted here",
    "model": "keys with values are wanted here",
    "mapping": "keys with values are wanted here",
}
LIMITS = {
    "greater_than_equal": ("at least", "ge"),
    "greater_than": ("more than", "gt"),
    "less_than_equal": ("at most", "le"),
    "less_than": ("less than", "lt"),
}


def retell(
    error: ValidationError, at: At, adapter: TypeAdapter[Any], more: Iterable[str] = ()
) -> list[SheetError]:
    """The faults in a value that did not fit its model; `more` are further keys allowed at its top."""
    listed = error.errors(include_url=False)
    entries = [_Entry(dict(entry), at, adapter, tuple(more)) for entry in listed[:MOST]]
    faults = [(entry, entry.fault()) for entry in entries if not _told_before(entry, entries)]
    told = {entry.route for entry in entries if entry.type not in OTHER_FORM}
    faults = [
        (entry, fault) for entry, fault in faults if entry.type not in OTHER_FORM or entry.route not in told
    ]
    misspelt = {
        (entry.route[:-1], meant["key"])
        for entry, fault in faults
        if entry.type == "extra_forbidden" and (meant := MEANT.fullmatch(fault.hint))
    }
    found: dict[tuple[Any, ...], SheetError] = {}
    for entry, fault in faults:
        if entry.type == "missing" and entry.is_misspelt({key for at, key in misspelt if at == entry.route}):
            continue
        several = (
            fault.message if entry.type == "missing" else ""
        )  # more than one key can be missing in a place
        found.setdefault((fault.place, several), fault)
    return [*found.values(), *untold(len(listed) - MOST, list(found.values()))]


def _told_before(entry: _Entry, entries: list[_Entry]) -> bool:
    """Whether a piece that was cut off at a comma belongs to a value whose fault is told."""
    if entry.rest is None:
        return False
    whole = before(entry.at, entry.rest)
    return any(other.route[: len(whole)] == whole for other in entries)


def untold(count: int, told: Sequence[SheetError]) -> list[SheetError]:
    """How many faults are not told one by one, where the last one stands that is."""
    if count <= 0:
        return []
    last = max(told, key=position)
    return [SheetError(f"{count} more faults are here", last.place, "mend those above first")]


SURELY = 0.93  # a likeness beside which no other word is thought of
MEANT = re.compile(r"did you mean (?P<key>.*)\?")


def did_you_mean(typed: str, known: Iterable[str], what: str = "") -> str:
    """A hint: the closest of the known names (the first of those that are equally close) or what others call
    by this word, else all of them."""
    names = sorted(known, reverse=True) if isinstance(known, Set) else list(dict.fromkeys(known))
    if (ours := our_word(typed, names)) and not get_close_matches(typed, names, n=1, cutoff=SURELY):
        return f"did you mean {ours}?"
    if close := get_close_matches(typed, names, n=3, cutoff=0.6):
        best = _likeness(close[0], typed)
        return f"did you mean {next(name for name in names if _likeness(name, typed) == best)}?"
    return f"{what or 'one of'}: {', '.join(sorted(names))}" if names else ""


def _likeness(name: str, typed: str) -> float:
    return SequenceMatcher(None, name, typed).ratio()


def formula_fault(error: FormulaError, at: At, route: Route = ()) -> SheetError:
    """A fault inside a formula, at its very character."""
    hint = error.hint
    if "never closed" in error.message and _cut_at_comma(at, route):
        hint = "put quotes around a formula with a comma in it"
    return SheetError(error.message, at.place(route, error.offset), hint)


def _cut_at_comma(at: At, route: Route) -> bool:
    """Whether YAML ended the formula at a comma and what closes it comes later, as in {b: atan2(3, 4)}."""
    place, text = at.place(route), at.value(route)
    after = place.text[place.column - 1 + len(text) :].lstrip() if isinstance(text, str) else ""
    rest = after.partition("(")[0]
    return after.startswith(",") and ")" in rest


class _Entry:
    """One of pydantic's faults, brought to the place in the file."""

    def __init__(
        self, entry: dict[str, Any], at: At, adapter: TypeAdapter[Any], more: tuple[str, ...]
    ) -> None:
        self.type: str = entry["type"]
        self.context: dict[str, Any] = entry.get("ctx", {})
        self.message: str = entry["msg"]
        self.at = at
        self.adapter = adapter
        self.more = more
        self.location: tuple[str | int, ...] = entry["loc"]
        self.route = self._route()
        self.rest = cut_off(at, self.route)

    def fault(self) -> SheetError:
        error = self.context.get("error")
        if self.rest is not None:
            return cut_fault(self.at, self.rest)
        if isinstance(error, FormulaError):
            return formula_fault(error, self.at, self.route)
        if self.type == "missing":
            return self._missing()
        if self.type == "extra_forbidden":
            return self._unknown()
        if self.type == "literal_error":
            return self._choice()
        if self.type == NO_FORM:
            return self._no_form()
        return self._other(str(error) if error else "")

    def is_misspelt(self, meant: Set[str]) -> bool:
        """Whether what is missing stands there misspelt, or a key with which it could not stand."""
        name = self.location[-1]
        if not meant or name in meant:
            return bool(meant)
        forms = [branch.get("properties", {}) for branch in branches(self.adapter, self.route)]
        return not any(name in form and key in form for form in forms for key in meant)

    def _route(self) -> Route:
        """The location without the tags of unions (`=rod`), which are no keys of the file."""
        route: Route = ()
        for step in self.location:
            value = self.at.value(route)
            if isinstance(value, dict):
                inside = step in value
            else:
                inside = isinstance(value, list) and isinstance(step, int) and step < len(value)
            if inside:
                route = (*route, step)
        return route

    def _missing(self) -> SheetError:
        name, value = self.location[-1], self.at.value(self.route)
        if isinstance(name, int):
            count = len(value) if isinstance(value, list) else 0
            counts = lengths(self.adapter, self.route)
            wanted = " or ".join(map(str, sorted(counts))) or "more"
            hint = _several(*counts) if len(counts) == 1 else "" if counts else f"give at least {name + 1}"
            return self.at.fault(f"{wanted} values are wanted here, not {count}", self.route, hint)
        return self.at.fault(f"'{name}' is missing", self._owner(), f"add {name}: ...", key=True)

    def _owner(self) -> Route:
        """The value that lacks something; a question is pointed at where its kind is named."""
        value = self.at.value(self.route)
        return (*self.route, "find") if isinstance(value, dict) and "find" in value else self.route

    def _no_form(self) -> SheetError:
        """A misspelt key where there is one, else what could be written."""
        value = self.at.value(self.route)
        known = keys(self.adapter, self.route)
        for key in value if isinstance(value, dict) else ():
            if key not in known:
                hint = did_you_mean(key, known, "what can stand here")
                return self.at.fault(f"unknown key '{key}'", (*self.route, key), hint, key=True)
        return self.at.fault(self.message, self.route)

    def _unknown(self) -> SheetError:
        name = str(self.route[-1])
        if isinstance(self.route[-1], int):
            return self.at.fault("too many values here", self.route)
        known = (*keys(self.adapter, self.route[:-1]), *self._more())
        if name in known:  # of another form of what is described here
            beside = next(key for key in self.at.value(self.route[:-1]) if key != name)
            hint = f"leave it out, or describe it in the way in which {name} is used"
            return self.at.fault(f"'{name}' is not used beside '{beside}'", self.route, hint, key=True)
        hint = did_you_mean(name, known, "what can stand here")
        return self.at.fault(f"unknown key '{name}'", self.route, hint, key=True)

    def _more(self) -> tuple[str, ...]:
        return self.more if len(self.route) == 1 else ()

    def _choice(self) -> SheetError:
        value, said = self.at.value(self.route), purpose(self.adapter, self.route)
        typed = value if isinstance(value, str) else ""
        known = [name.strip("' ") for name in str(self.context["expected"]).replace(" or ", ",").split(",")]
        named = {word.lower(): way for way, words in NAMED.findall(said) for word in words.split(", ")}
        way = named.get(typed.lower())
        hint = f"write {way}" if way in known else did_you_mean(typed, known)
        if not hint.startswith("did") and (example := EXAMPLE.search(said)):
            hint += f", or {example['like']}"
        what = f"'{typed}'" if typed else "a list" if isinstance(value, list) else "this"
        return self.at.fault(f"{what} cannot stand here", self.route, hint)

    def _other(self, said: str) -> SheetError:
        if self.type in LIMITS:
            words, name = LIMITS[self.type]
            return self.at.fault(f"this must be {words} {self.context[name]}", self.route)
        if self.type == "too_short":
            least = self.context["min_length"]
            given = self.context.get("actual_length")
            said = "this list is empty" if given == 0 else f"at least {least} must be given here, not {given}"
            return self.at.fault(said, self.route)
        if self.type == "too_long":
            most, given = self.context["max_length"], self.context["actual_length"]
            if self.context.get("field_type") == "Tuple":
                return self.at.fault(f"{most} values are wanted here, not {given}", self.route)
            return self.at.fault(f"at most {most} can stand here, not {given}", self.route)
        if said == "" and (form := self._form()):
            return form
        wanted = WANTED.get(self.type.split("_")[0], "")
        place = self.route if said == "" else self._owner()
        return self.at.fault(said or wanted or self.message.lower(), place, key=place != self.route)

    def _form(self) -> SheetError | None:
        """Where keys or a list are wanted: which keys, and how many values."""
        forms = branches(self.adapter, self.route)
        if self.type in ("model_type", "model_attributes_type"):
            required: list[str] = next((wanted for form in forms if (wanted := form.get("required"))), [])
            hint = f"write {{{', '.join(f'{key}: ...' for key in required)}}}" if required else ""
            for form in forms:
                if example := OBJECT.search(str(form.get("description", ""))):
                    hint = f"write {example['object']}"
            return self.at.fault("keys with values are wanted here", self.route, hint)
        if self.type in ("list_type", "tuple_type"):
            counts, value = lengths(self.adapter, self.route), self.at.value(self.route)
            hint = "begin each entry with '- ', or write [{...}]" if isinstance(value, dict) else ""
            if isinstance(value, str):
                hint = f"write [{value}]"
            if example := EXAMPLE.search(purpose(self.adapter, self.route)):
                hint = f"write {example['like']}"
            elif len(counts) == 1:
                hint = _several(counts.pop())
            return self.at.fault("a list is wanted here", self.route, hint) if hint else None
        if self.type == "dict_type":
            return self.at.fault("keys with values are wanted here", self.route, "write {name: ...}")
        return None


def _several(count: int) -> str:
    return f"write [{', '.join(['...'] * count)}]"

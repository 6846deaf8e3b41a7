"""The templates of an instructor's own folder, and what they may do: name what a template of the house may
name, and nothing behind it.

No attribute is reached but those of our records and a few of texts and lists; no file is read outside of the
folder; what a page costs is counted, and so are the letters that it makes.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from functools import wraps
from pathlib import Path, PurePosixPath
from types import MappingProxyType

from jinja2 import BaseLoader, Environment, TemplateNotFound, TemplateSyntaxError, nodes
from jinja2.environment import TemplateModule
from jinja2.exceptions import SecurityError
from jinja2.runtime import Context, LoopContext, TemplateReference
from jinja2.sandbox import ImmutableSandboxedEnvironment
from jinja2.utils import Namespace
from jinja2.visitor import NodeTransformer

from derive.known.files import lies_below
from derive.render.skin import Dressing

WORK = 1_000_000  # of one page: calls, rounds of loops, pieces of text; ours take up to 10,000
PIECE = 64  # letters of a text that cost as much as a call
LONGEST = 1_000_000  # letters of a text
LARGEST = 10**12  # of a number that is calculated
FILE = 200_000  # bytes
OF_TEXTS = """capitalize endswith isdecimal isupper lower lstrip removeprefix removesuffix rstrip split
startswith strip title upper"""
OF_MAPPINGS = "get items keys values"
METHODS: Mapping[type, str] = {
    str: OF_TEXTS, dict: OF_MAPPINGS, MappingProxyType: OF_MAPPINGS, list: "append",
}  # fmt: skip
OF_JINJA = (LoopContext, TemplateModule, TemplateReference, Namespace)
OURS = "derive"  # the package of the records
CALLED = {"derive.render.skin.Skin"}  # records whose methods are for templates
FILTERS = """abs capitalize count d default e escape first groupby int items join last length list lower map
max min reject rejectattr reverse select selectattr sort string sum title trim unique upper"""


class Folder(BaseLoader):
    """The templates of one folder. Links that lead out of it are not followed."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder

    def get_source(self, environment: Environment, template: str) -> tuple[str, str, Callable[[], bool]]:
        """The text of a template, where it lies, and whether that is still so. Raises TemplateNotFound, and
        TemplateSyntaxError for a file that is none."""
        if ".." in PurePosixPath(template).parts:
            raise TemplateNotFound(template)
        path = self.folder / template
        inside = lies_below(path, self.folder)
        if not inside or not path.is_file():
            raise TemplateNotFound(template)
        if path.stat().st_size > FILE:
            raise TemplateSyntaxError(f"a template has at most {FILE} bytes", 1, template, str(path))
        try:
            text = path.read_text(encoding="utf-8-sig")
        except UnicodeDecodeError as error:
            raise TemplateSyntaxError("this is no text in UTF-8", 1, template, str(path)) from error
        written = path.stat().st_mtime_ns
        return text, str(path), lambda: path.is_file() and path.stat().st_mtime_ns == written


class Sandbox(ImmutableSandboxedEnvironment, Dressing):
    """Templates held to what the module says."""

    intercepted_binops = frozenset({"+", "-", "*", "/", "//", "%", "**"})
    left = WORK

    def restrict(self, folder: Path, own: Iterable[str]) -> None:
        """Takes away the filters and functions that could make much of little, and counts what remain."""
        self.folder = folder
        self.own = frozenset(own)
        for name in {*self.globals} - {"range", "dict", "namespace"}:
            del self.globals[name]
        self.filters = {
            name: self._counting(found)
            for name, found in self.filters.items()
            if name in FILTERS.split() or found.__module__.startswith(f"{OURS}.")
        }
        self.filters |= {"counted": self.counted, "bounded": self.bounded}
        self.filters |= {"join": self._join, "replace": self._replace}
        self.finalize = self._printed

    def begin(self) -> None:
        """A page begins."""
        self.left = WORK

    def spend(self, work: int) -> None:
        """Raises SecurityError where a page costs too much."""
        self.left -= work
        if self.left < 0:
            raise SecurityError("a page of this template has no end: it loops too often")

    def is_safe_attribute(self, obj: object, attr: str, value: object) -> bool:
        """Whether a template may see it: a datum of a record of ours, a harmless method."""
        if attr.startswith("_"):
            return False
        kind = type(obj)
        if isinstance(obj, OF_JINJA) or attr in METHODS.get(kind, "").split():
            return True
        homes = {f"{each.__module__}.{each.__qualname__}" for each in kind.__mro__}
        ours = any(home.startswith(f"{OURS}.") for home in homes)
        return ours and (not callable(value) or bool(homes & CALLED))

    def call(self, context: Context, obj: Callable[..., object], *args: object, **kwargs: object) -> object:
        """Calls what a template calls."""
        self.spend(1)
        if isinstance(obj, type) and obj is not dict and obj is not Namespace:
            raise SecurityError(f"{obj!r} is not for templates")
        return self.bounded(super().call(context, obj, *args, **kwargs))

    def call_binop(self, context: Context, operator: str, left: object, right: object) -> object:
        """Calculates with numbers, and puts texts or lists together."""
        self.spend(1)
        done: object = None
        match left, right:
            case (int() | float(), int() | float()) if operator != "**":
                done = self.binop_table[operator](left, right)
            case (str(), str()) | (list(), list()) | (tuple(), tuple()) if operator == "+":
                done = self.binop_table[operator](left, right)
            case (str(), int()) if operator == "*" and len(left) * right <= LONGEST:
                done = left * right
        if done is None or (isinstance(done, int | float) and abs(done) > LARGEST):
            what = f"{type(left).__name__} {operator} {type(right).__name__}"
            raise SecurityError(f"{what} is not for templates, or too large")
        return self.bounded(done)

    def counted(self, values: Iterable[object], letters: int = 0) -> Iterator[object]:
        """What a loop goes through, its body having so many letters."""
        for value in values:
            self.spend(1 + letters // PIECE)
            yield value

    def bounded(self, value: object) -> object:
        """The value, if no text or list of great length."""
        if isinstance(value, str | list | tuple):
            self.spend(len(value) // PIECE)
            if len(value) > LONGEST:
                raise SecurityError(f"something of {len(value)} letters or parts is too long")
        return value

    def _printed(self, value: object) -> object:
        """What goes onto the page, where a whole body may stand."""
        self.spend(len(value) // PIECE if isinstance(value, str) else 0)
        return value

    def _counting(self, filtered: Callable[..., object]) -> Callable[..., object]:
        """The filter, what it goes through and makes being counted."""

        @wraps(filtered)
        def counting(*values: object, **options: object) -> object:
            seen = (
                self.counted(each) if isinstance(each, Iterator) else self.bounded(each) for each in values
            )
            return self.bounded(filtered(*seen, **options))

        return counting

    def _join(self, values: Iterable[object], between: str = "") -> object:
        texts = [str(self.bounded(value)) for value in self.counted(values)]
        if sum(map(len, texts)) + len(texts) * len(between) > LONGEST:
            raise SecurityError("the text would be too long")
        return self.bounded(between.join(texts))

    def _replace(self, text: str, old: str, new: str) -> object:
        if len(text) + text.count(old) * len(new) > LONGEST:
            raise SecurityError("the text would be too long")
        return self.bounded(str(text).replace(old, new))

    def _generate(
        self, source: nodes.Template, name: str | None, filename: str | None, defer_init: bool = False
    ) -> str:
        return super()._generate(_Counted(self).visit(source), name, filename, defer_init)


class _Counted(NodeTransformer):
    """Puts `counted` round what loops go through, and `bounded` round texts that are put together."""

    def __init__(self, environment: Environment) -> None:
        self.environment = environment

    def visit_For(self, node: nodes.For) -> nodes.For:
        letters = sum(len(each.data) for each in node.find_all(nodes.TemplateData))
        self.generic_visit(node)
        node.iter = self._by("counted", node.iter, nodes.Const(letters))
        return node

    def visit_Concat(self, node: nodes.Concat) -> nodes.Filter:
        self.generic_visit(node)
        return self._by("bounded", node)

    def visit_AssignBlock(self, node: nodes.AssignBlock) -> nodes.AssignBlock:
        self.generic_visit(node)
        node.filter = self._by("bounded", node.filter)
        return node

    def _by(self, name: str, node: nodes.Node | None, *arguments: nodes.Expr) -> nodes.Filter:
        made = nodes.Filter(node, name, [*arguments], [], None, None)
        if node is not None:
            made.set_lineno(node.lineno, override=False)
        made.set_environment(self.environment)
        return made

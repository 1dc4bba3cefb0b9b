"""What the names of the code are in one node: with its parameters, remappings and namespace."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TypeAlias

from rebsync.records import dataclass
from rebsync.reverse.graph import FromParameter, OneOf, Place, Resolved, Under, Unresolved
from rebsync.reverse.launch.graph_names import join, resolve
from rebsync.reverse.launch.launched import Launch, LaunchedNode
from rebsync.reverse.launch.parameters import Parameter
from rebsync.reverse.unknowns import Open, Text

OWN_NAME = "{name}"  # stands for the last part of the name of the node itself in a name
_BY_PARAMETER = "the parameter that it comes from is not known"


@dataclass(frozen=True, slots=True)
class KnownName:
    """A name; `certain` says that nothing but an edit of the code or launch file changes it."""

    text: str
    certain: bool = True


@dataclass(frozen=True, slots=True)
class UnknownName:
    """A name that is not known: why, where that is so, and what it looks like; `*` is any text."""

    why: str
    place: Place | None = None
    pattern: str = "*"


Name: TypeAlias = "KnownName | UnknownName"


@dataclass(frozen=True, slots=True)
class Naming:
    """Resolves the names of one node; `own` is the name of the node itself.

    Without `launched` nothing is remapped and no parameter is set, though any could be. `is_flat`
    says that parameters are the node's own.
    """

    own: str | None
    is_flat: bool
    launched: LaunchedNode | None = None
    launch: Launch | None = None

    def names(self, value: Resolved) -> Iterator[Name]:
        """The absolute names that a value of the code may be."""
        for found in self.values(value):
            yield found if isinstance(found, UnknownName) else self._absolute(found)

    def _absolute(self, name: KnownName) -> Name:
        meant = self.before_remapping(name.text)
        for remap in self.launched.remaps if self.launched is not None else ():
            if self.before_remapping(remap.private) == self.before_remapping(name.text):
                target = remap.target
                meant = target if isinstance(target, Open) else self.before_remapping(target)
        if isinstance(meant, Open):
            last = name.text.removeprefix("~").strip("/")
            return UnknownName(meant.why, None, f"*/{last}")
        return KnownName(meant, name.certain)

    def before_remapping(self, name: str) -> Text:
        """The absolute name that the code means."""
        namespace: Text = self.launched.namespace if self.launched is not None else "/"
        own: Text = self.own if self.own is not None else Open("the name of its node is not known")
        if OWN_NAME in name and self.own is not None:
            name = name.replace(OWN_NAME, self.own.rpartition("/")[2])
        return own if OWN_NAME in name else resolve(name, namespace, own)

    # --- values -------------------------------------------------------------------------------

    def values(self, value: Resolved) -> Iterator[Name]:
        """The texts that a value may be, not resolved."""
        match value:
            case str() if value:
                yield KnownName(value)
            case FromParameter():
                yield from self._from_parameter(value)
            case OneOf(values):
                for each in values:
                    for found in self.values(each):
                        yield (
                            KnownName(found.text, False) if isinstance(found, KnownName) else found
                        )
            case Under(name, handles):
                inner = join(handles[0], name) if len(handles) == 1 else None
                why = "its node handle comes from outside of the files"
                known = isinstance(inner, str)
                yield KnownName(str(inner)) if known else UnknownName(why, None, f"*{name}")
            case Unresolved(why, place, partial):
                yield UnknownName(why, place, partial or "*")
            case _:
                yield UnknownName("it is no text")

    def _from_parameter(self, value: FromParameter) -> Iterator[Name]:
        set_ = self._parameter(value)
        if value.expression is not None:
            yield UnknownName(_BY_PARAMETER)
        elif set_ is not None:
            text = set_.value
            known = isinstance(text, str) and text
            yield self._within(value, KnownName(str(text))) if known else UnknownName(_BY_PARAMETER)
        elif value.default is not None:
            for found in self.values(value.default):
                certain = self.launched is not None and not self._is_open
                is_known = isinstance(found, KnownName)
                text = found.text if isinstance(found, KnownName) else ""
                yield self._within(value, KnownName(text, certain)) if is_known else found
        else:
            yield UnknownName(_BY_PARAMETER)

    def _within(self, value: FromParameter, name: KnownName) -> Name:
        if len(value.within) > 1:
            return UnknownName("one of several namespaces", None, f"*{name.text}")
        inner = join(value.within[0], name.text) if value.within and value.within[0] else name.text
        return KnownName(inner, name.certain) if isinstance(inner, str) else UnknownName(inner.why)

    def _parameter(self, value: FromParameter) -> Parameter | None:
        """The parameter, where the launch files set it."""
        name = value.name
        if self.launched is None or not isinstance(name, str):
            return None
        if self.is_flat:
            own = self.launched.parameter(name.replace(".", "/"))
            return own or self._global(f"/{name.replace('.', '/')}")
        absolute, private = self.before_remapping(name), self.launched.private_namespace
        if isinstance(absolute, Open) or isinstance(private, Open):
            return None
        if absolute.startswith(private):
            return self.launched.parameter(absolute.removeprefix(private))
        return self._global(absolute)

    def _global(self, name: str) -> Parameter | None:
        everywhere = self.launch.parameters if self.launch is not None else ()
        return next((p for p in everywhere if p.name == name), None)

    @property
    def _is_open(self) -> bool:
        """Whether some parameters of launch files are not known."""
        if self.launch is None or self.launched is None:
            return True
        return any("parameter" in u.what for u in self.launch.unknowns)

"""A client library that there is not, in the manner of Zenoh: all that its support takes."""

from __future__ import annotations

from rebsync.reverse.libraries.routines import Access, Effect, Kind, Language, Library, Routine

_TYPES = (("type", "type"), ("key", "name"), ("handler", "callback"), ("seconds", "period"))


def _asks(kind: Kind, *arguments: str, access: Access | None = None, least: int = 9) -> Routine:
    return Routine(kind, arguments, _TYPES, access, flat=True, least=least)


def _library(language: Language, scope: str, typed: tuple[str, ...]) -> Library:
    """The library in a language: `typed` is what stands before a key, the type or nothing."""
    session = f"mesh{scope}Session"
    opened = _asks(Kind.NODE, "name")
    functions = {
        session: opened,
        f"mesh{scope}open": opened,
        f"mesh{scope}log_info": Routine(Kind.LOG),
        f"mesh{scope}alive": Routine(Kind.RUNNING, result="bool"),
        f"mesh{scope}pause": Routine(Kind.SLEEP, ("period",), result="seconds"),
        f"mesh{scope}time": Routine(Kind.CLOCK, result="seconds"),
    }
    on_session = {
        "declare_publisher": _asks(Kind.PUBLISHER, *typed, "name", "depth"),
        "declare_subscriber": _asks(Kind.SUBSCRIPTION, *typed, "name", "callback"),
        "every": _asks(Kind.TIMER, "period", "callback"),
        "parameter": _asks(Kind.PARAMETER, "name", "default", access=Access.DECLARE),
        "run": Routine(Kind.SPIN),
        "close": Routine(Kind.START, does=Effect.ENDS),
    }
    on_publisher = {"put": Routine(Kind.PUBLISH, ("message",))}
    return Library(
        "mesh",
        language,
        functions,
        {session: on_session, f"mesh{scope}Publisher": on_publisher},
        nodes=frozenset({session}),
        marks=("mesh",),
        starts=("mesh",),
    )


LIBRARIES = (
    _library(Language.CPP, "::", ()),
    _library(Language.PYTHON, ".", ("type",)),
)

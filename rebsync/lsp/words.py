"""What editors tell of a word of the language, and what its author says above a declaration."""

from __future__ import annotations

import re

_WORDS = {
    "@Robot": "a robot: its instances move, and have parameters and topics of their own",
    "@Controller": "a controller: others send to it below `control_bridge`",
    "@Sensor": "sends to itself at a rate, and reads a sensor where it chooses a value",
    "@Port": "the topic of this server is below `port`: others are meant to send to it",
    "@Service": "is offered as a service too; the servers named are the answer",
    "@Action": "is offered as an action too; the servers named are its result, and its feedback",
    "@Open": "somebody outside of the model sends this",
    "@KeepLast": "of its messages from other rebecs the last n stay",
    "@Move": "moves the robot to the cell X, Y, for as long as the delay that follows",
    "@priority": "of what arrives at one moment in one rebec, the lowest number is served first",
    "@globalPriority": "of rebecs that can act at one moment, those with the lowest number do",
    "after": "the message arrives so many units of time later",
    "deadline": "the message must be served within so many units of time",
    "msgsrv": "what a rebec does when it takes a message of this name from its queue",
    "knownrebecs": "the rebecs that this one can send to",
    "statevars": "what a rebec remembers from message to message",
    "reactiveclass": "rebecs of a kind; the number is the length of their queues",
    "env": "a constant of the model; of the ROS package a parameter",
    "main": "the instances: the rebecs they know, then the arguments of their constructors",
}
_TOKEN = re.compile(
    r'//[^\n]*|/\*.*?(?:\*/|\Z)|"(?:[^"\\\n]|\\.)*"|(@?[A-Za-z_$][\w$]*)', re.DOTALL
)


def word_at(text: str, offset: int) -> tuple[int, int, str] | None:
    """The word of the language at an offset: where it begins and ends, and what it means."""
    for token in _TOKEN.finditer(text):
        if token.start() <= offset <= token.end() and token[1] in _WORDS:
            return token.start(), token.end(), _WORDS[token[1]]
        if token.start() > offset:
            break
    return None


def remark_of(text: str, offset: int) -> str:
    """The comment behind a declaration at an offset, or else those of whole lines right above it.

    Annotations may be between.
    """
    declaration, _, behind = text[offset:].partition("\n")[0].partition("//")
    if behind and declaration.rstrip().endswith(";"):
        return behind.strip()
    found: list[str] = []
    for line in reversed(text[:offset].split("\n")[:-1]):
        said = line.strip()
        if said.startswith("//"):
            found.append(said.lstrip("/").strip())
        elif found or not said.startswith("@"):
            break
    return "\n".join(reversed(found))

"""What C++ for ROS 1 and for ROS 2 call differently: each of the two is a module of these names."""

from __future__ import annotations

from typing import Protocol

from rebsync.package import Offer


class CppWords(Protocol):
    """The words of one generation of ROS; message names without a package are the package's own."""

    @property
    def TEMPLATES(self) -> str:
        """The folder of the templates."""

    @property
    def HEADER(self) -> str:
        """What the names of headers end in."""

    @property
    def FRAME(self) -> str:
        """The header that every class includes."""

    @property
    def BREAKS_LINES(self) -> bool:
        """Whether the lines that set up topics are broken where they are too long."""

    @property
    def TYPED_PUBLISHERS(self) -> bool:
        """Whether the member that publishes names the type of its messages."""

    def guard(self, package: str, stem: str) -> str:
        """The macro that guards a header of the package."""

    def message(self, type_: str) -> str:
        """A message type, `Ping` or `sensor_msgs/LaserScan`, inside the package's namespace."""

    def message_header(self, package: str, type_: str) -> str:
        """The header of a message type."""

    def offer(self, offered: Offer) -> str:
        """A service or action type, inside the package's namespace."""

    def offer_header(self, package: str, offered: Offer) -> str:
        """The header of a service or action type."""

    def offered(self, offered: Offer) -> str:
        """What offers a service or an action of a type."""

    def received(self, type_: str) -> str:
        """What points at a message that came in."""

    def published(self, publisher: str) -> str:
        """The function that publishes."""

    def truth(self, field: str) -> str:
        """A field of type bool as a bool of C++."""

    def publisher(self, type_: str) -> str:
        """What publishes messages of a type."""

    def publishers(self, type_: str) -> str:
        """Publishers to each rebec that a variable may stand for."""

    def subscriber(self, type_: str) -> str:
        """What subscribes to messages of a type."""

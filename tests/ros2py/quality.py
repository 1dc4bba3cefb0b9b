"""Qualities of service, and the parameters that override them, as rclpy has them."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from enum import Enum, IntEnum
from types import ModuleType, SimpleNamespace

_DEPTH = 10
_SENSORS = 5


class HistoryPolicy(Enum):
    SYSTEM_DEFAULT = 0
    KEEP_LAST = 1
    KEEP_ALL = 2


class ReliabilityPolicy(Enum):
    SYSTEM_DEFAULT = 0
    RELIABLE = 1
    BEST_EFFORT = 2


class DurabilityPolicy(Enum):
    SYSTEM_DEFAULT = 0
    TRANSIENT_LOCAL = 1
    VOLATILE = 2


class LivelinessPolicy(Enum):
    SYSTEM_DEFAULT = 0
    AUTOMATIC = 1
    MANUAL_BY_TOPIC = 3


class QoSPolicyKind(IntEnum):
    INVALID = 0
    DURABILITY = 1
    DEADLINE = 2
    LIVELINESS = 3
    RELIABILITY = 4
    HISTORY = 5
    LIFESPAN = 6
    DEPTH = 7
    LIVELINESS_LEASE_DURATION = 8
    AVOID_ROS_NAMESPACE_CONVENTIONS = 9


@dataclass
class QoSProfile:
    """Policies; times are in nanoseconds."""

    depth: int = _DEPTH
    history: HistoryPolicy = HistoryPolicy.KEEP_LAST
    reliability: ReliabilityPolicy = ReliabilityPolicy.RELIABLE
    durability: DurabilityPolicy = DurabilityPolicy.VOLATILE
    deadline: int = 0
    lifespan: int = 0
    liveliness: LivelinessPolicy = LivelinessPolicy.SYSTEM_DEFAULT
    liveliness_lease_duration: int = 0
    avoid_ros_namespace_conventions: bool = False

    @property
    def keeps(self) -> bool:
        return self.durability is DurabilityPolicy.TRANSIENT_LOCAL

    def offers(self, asked: QoSProfile) -> bool:
        """Whether what is asked for is no more than this: nothing is heard otherwise."""
        reliable = ReliabilityPolicy.RELIABLE
        safe = self.reliability is reliable or asked.reliability is not reliable
        return safe and (self.keeps or not asked.keeps)


class InvalidQosOverridesError(Exception):
    """A callback refused the profile."""


class QoSOverridingOptions:
    """Which policies parameters may override, and what looks at the result."""

    def __init__(
        self,
        policy_kinds: Iterable[QoSPolicyKind],
        *,
        callback: Callable[[QoSProfile], SimpleNamespace] | None = None,
    ) -> None:
        self.policy_kinds = tuple(policy_kinds)
        self.callback = callback

    @classmethod
    def with_default_policies(
        cls, *, callback: Callable[[QoSProfile], SimpleNamespace] | None = None
    ) -> QoSOverridingOptions:
        kinds = QoSPolicyKind.HISTORY, QoSPolicyKind.DEPTH, QoSPolicyKind.RELIABILITY
        return cls(kinds, callback=callback)


def override(
    entity: str,
    qos: QoSProfile | int,
    options: QoSOverridingOptions | None,
    declare: Callable[[str, object], object],
) -> QoSProfile:
    """The profile with what parameters say, which is written into the given one, as rclpy does."""
    profile = QoSProfile(depth=qos) if isinstance(qos, int) else qos
    kinds = options.policy_kinds if options is not None else ()
    for kind in kinds:
        if kind is QoSPolicyKind.LIFESPAN and entity.endswith(".subscription"):
            continue
        if kind is QoSPolicyKind.INVALID:
            raise AttributeError(kind.name)
        name = kind.name.lower()
        value = getattr(profile, name)
        if isinstance(value, Enum):
            said = declare(f"qos_overrides.{entity}.{name}", value.name.lower())
            setattr(profile, name, type(value)[str(said).upper()])
        else:
            setattr(profile, name, declare(f"qos_overrides.{entity}.{name}", value))
    if options is not None and options.callback is not None:
        result = options.callback(profile)
        if not result.successful:
            raise InvalidQosOverridesError(result.reason)
    return profile


def modules() -> list[tuple[str, ModuleType]]:
    """`rclpy.qos` and `rclpy.qos_overriding_options`."""
    sensors = QoSProfile(depth=_SENSORS, reliability=ReliabilityPolicy.BEST_EFFORT)
    policies = (HistoryPolicy, ReliabilityPolicy, DurabilityPolicy, QoSPolicyKind, QoSProfile)
    qos, overriding = ModuleType("rclpy.qos"), ModuleType("rclpy.qos_overriding_options")
    qos.__dict__.update({c.__name__: c for c in policies}, qos_profile_sensor_data=sensors)
    overriding.__dict__.update(QoSOverridingOptions=QoSOverridingOptions)
    return [(qos.__name__, qos), (overriding.__name__, overriding)]

"""A rebec whose bodies are scripts from the parameter server."""

from __future__ import annotations

import os
import signal
import time

import rospy

from probe.drive import Drive
from probe.mailbox import Mailbox, Served, to
from probe.msg import Note, ScriptState
from probe.sensor import Sensor
from probe.values import Array, Server, When, divide, priority, text

SERVERS = {
    "plain": Server("plain"),
    "low": Server("low", priority(2)),
    "high": Server("high", priority(1)),
}


class Script:
    def __init__(self) -> None:
        self.mailbox = Mailbox(rospy.get_param("~capacity", 20), SERVERS["high"].priority)
        self.drive = Drive(self.mailbox)
        self.sensor = Sensor("~sensor", Note)
        self.state = rospy.Publisher("~state", ScriptState, queue_size=100, latch=True)
        self.value = 0
        self.notes: list[int] = []
        peers = rospy.get_param("~peers", [])
        self.publishers = {
            name: {p: self.mailbox.advertise(f"~{p}/{name}", Note) for p in peers}
            for name in SERVERS
        }
        self.scripts = {n: rospy.get_param(f"~script/{n}", []) for n in ("constructor", *SERVERS)}
        self.subscribers = [
            self.mailbox.subscribe("~plain", Note, self.receive_plain),
            self.mailbox.subscribe("~low", Note, self.receive_low),
            self.mailbox.subscribe("~high", Note, self.receive_high),
        ]
        self.mailbox.on_served(self.publish_state)
        self.mailbox.construct(lambda: self.run("constructor", 0))

    def run(self, server: str, value: int) -> None:
        self.value = value
        for line in self.scripts[server]:
            self.step(line)

    def step(self, line: str) -> None:
        verb, *rest = line.split()
        if verb == "send":
            self.send(*rest)
            return
        if verb == "raw":
            self.send_unstamped(*rest)
            return
        x, y = (*map(int, rest), 0, 0)[:2]
        if verb == "delay":
            self.mailbox.delay(x)
        if verb == "move":
            self.drive.move(x, y)
        if verb == "index":
            Array([0, 0])[x]
        if verb == "divide":
            self.notes.append(divide(x, y))
        if verb == "assert":
            self.mailbox.assertion(x != 0, "x is not 0")
        if verb == "choose":
            self.notes.append(self.mailbox.choose([1, 2, 3, 4, 5, 6, 7]))
        if verb == "now":
            self.notes.append(self.mailbox.now())
        if verb == "is_script":
            self.notes.append(int(self.mailbox.is_a(self.mailbox.sender(), "Script")))
        if verb == "value":
            self.notes.append(self.value)
        if verb == "sense":
            self.sense()
        if verb == "kill":
            os.kill(os.getpid(), signal.SIGKILL)
        if verb == "interrupt":
            os.kill(os.getpid(), signal.SIGINT)
        if verb == "hang":
            time.sleep(x)
        if verb == "quit":
            os._exit(1)
        if verb == "throw":
            raise RuntimeError("of the user's code")

    # send <rebec> <server> <value> [after <t>] [deadline <t>]
    def send(self, rebec: str, name: str, given: str, *times: str) -> None:
        value = int(given)
        when = When(**{times[i]: int(times[i + 1]) for i in range(0, len(times), 2)})
        if rebec == "self":
            self.mailbox.post(SERVERS[name], when, text(value), lambda: self.run(name, value))
            return
        msg = Note(sender=self.mailbox.self(), value=value)
        receiver = self.mailbox.sender() if rebec == "sender" else rebec
        self.mailbox.publish(to(self.publishers[name], receiver), msg, when)

    # raw <rebec> <server> <value>: as somebody sends it who is no rebec
    def send_unstamped(self, rebec: str, name: str, given: str) -> None:
        to(self.publishers[name], rebec).publish(Note(value=int(given)))

    def sense(self) -> None:
        seen = self.sensor.seen(lambda note: note.value)
        self.notes.append(-1 if seen is None else seen)
        self.notes.append(self.mailbox.choose([4, 5], seen))

    def receive_plain(self, msg: Note) -> None:
        self.receive("plain", msg)

    def receive_low(self, msg: Note) -> None:
        self.receive("low", msg)

    def receive_high(self, msg: Note) -> None:
        self.receive("high", msg)

    def receive(self, name: str, msg: Note) -> None:
        arguments = text(msg.value)
        serve = lambda: self.run(name, msg.value)  # noqa: E731
        self.mailbox.receive(SERVERS[name], msg.timing, msg.sender, arguments, serve)

    def publish_state(self, served: Served) -> None:
        msg = ScriptState(**served._asdict())
        msg.sender = self.mailbox.sender()
        msg.expiry = self.mailbox.expiry()
        msg.waiting = self.mailbox.waiting_time()
        msg.notes = list(self.notes)
        self.state.publish(msg)

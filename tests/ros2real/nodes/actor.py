"""Sends goals, all at once where they are in one list; prints a line of JSON for each list.

Of each goal: its state in the end, its result, its feedback. A goal of 100 or more is cancelled at
once, in vain: it is sent as its number less 100.
"""

import json
import sys
import time
from importlib import import_module

import rclpy
from rclpy.action import ActionClient

_REJECTED = 0
Task = import_module(f"{sys.argv[1]}.action").RobotTravelTask


def spin(futures: list) -> None:
    """Until all are there, for a minute at most."""
    ends = time.monotonic() + 60
    while not all(f.done() for f in futures) and time.monotonic() < ends:
        rclpy.spin_once(actor, timeout_sec=0.1)


def act(goals: list) -> list:
    """Sends goals, and waits for their ends."""
    said = [[] for _ in goals]
    sent = []
    for heard, to in zip(said, goals, strict=True):
        goal = Task.Goal(to=to % 100 if to >= 100 else to)
        feedback = lambda msg, heard=heard: heard.append(msg.feedback.place)  # noqa: E731
        sent.append(client.send_goal_async(goal, feedback_callback=feedback))
    spin(sent)
    handles = [future.result() for future in sent]
    cancels = [h.cancel_goal_async() for h, to in zip(handles, goals, strict=True) if to >= 100]
    print(json.dumps("sent"), flush=True)
    spin(cancels)
    ends = {i: h.get_result_async() for i, h in enumerate(handles) if h.accepted}
    spin(list(ends.values()))
    found = []
    for number, heard in enumerate(said):
        end = ends[number].result() if number in ends and ends[number].done() else None
        state = end.status if end is not None else _REJECTED
        place = end.result.place if end is not None else None
        found.append({"state": state, "place": place, "passed": heard})
    return [*found, *({"refused": not c.result().goals_canceling} for c in cancels)]


rclpy.init()
actor = rclpy.create_node("actor")
client = ActionClient(actor, Task, "/robot/travel")
assert client.wait_for_server(60)
time.sleep(2)
for group in json.loads(sys.argv[2]):
    print(json.dumps(act(group)), flush=True)

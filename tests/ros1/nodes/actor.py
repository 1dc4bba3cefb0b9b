"""Sends goals, all at once where they are in one list; prints a line of JSON for each list.

Of each goal: its state in the end, its result, its feedback. A goal of 100 or more is cancelled as
soon as it is accepted, in vain: it is sent as its number less 100. (One whose cancelling comes
before it is recalled by actionlib itself, and is no message.)
"""

import json
import sys
import time
from collections.abc import Callable

import actionlib
import rospy
from services.msg import RobotTravelTaskAction, RobotTravelTaskGoal


def wait(holds: Callable[[], bool]) -> None:
    """Waits for what is to hold, but no longer than a minute."""
    ends = time.monotonic() + 60
    while not holds() and time.monotonic() < ends:
        time.sleep(0.05)


def act(goals: list) -> list:
    """Sends goals, and waits for their ends."""
    said = [[] for _ in goals]
    handles = []
    for number, to in enumerate(goals):
        hear = said[number].append
        goal = RobotTravelTaskGoal(to=to % 100 if to >= 100 else to)
        handle = client.send_goal(goal, feedback_cb=lambda _, f, hear=hear: hear(f.place))
        handles.append(handle)
        if to >= 100:
            wait(lambda handle=handle: handle.get_comm_state() == actionlib.CommState.ACTIVE)
            handle.cancel()
    print(json.dumps("sent"), flush=True)
    wait(lambda: all(h.get_comm_state() == actionlib.CommState.DONE for h in handles))
    return [
        {
            "state": h.get_terminal_state(),
            "place": h.get_result().place if h.get_result() else None,
            "passed": heard,
        }
        for h, heard in zip(handles, said, strict=True)
    ]


rospy.init_node("actor")
client = actionlib.ActionClient("/robot/travel", RobotTravelTaskAction)
client.wait_for_server()
time.sleep(2)
for group in json.loads(sys.argv[1]):
    print(json.dumps(act(group)), flush=True)
